//! Atomic writes: a file is never incomplete, even if the process is killed.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::system;

/// Writes a file that everyone with access to its folder can read. Creates the folder if it does
/// not exist. The text goes to a temporary file in the same folder, which is then renamed.
pub fn write(text: &str, path: &Path) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(text.as_bytes())?;
    system::make_readable(file.as_file())?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
