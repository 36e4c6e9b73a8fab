//! Files that are whole at any moment, because they appear in one step.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::system;

/// Writes a file for whoever may read its folder, which is made if it is not there: to a temporary
/// file beside it, then in its place.
pub fn write(text: &str, path: &Path) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(text.as_bytes())?;
    system::make_readable(file.as_file())?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
