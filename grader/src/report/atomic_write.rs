//! Atomic writes: a file is never incomplete, even if the process is killed.

use std::fs;
use std::io::Write;
use std::path::Path;

use tempfile::NamedTempFile;

use crate::machine::disk::{self, Operation};
use crate::machine::files::{AtPath, PathError};
use crate::machine::system;

/// Writes a file that everyone with access to its folder can read. Creates the folder if it doesn't
/// exist. The contents go to a temporary file in the same folder, which is then renamed.
pub fn write(contents: impl AsRef<[u8]>, path: &Path) -> Result<(), PathError> {
    let contents = contents.as_ref();
    let written = || {
        let folder = path.parent().unwrap_or(Path::new("."));
        disk::before(Operation::CreateFolder(folder))?;
        fs::create_dir_all(folder)?;
        disk::before(Operation::CreateTemporary(folder))?;
        let mut file = NamedTempFile::new_in(folder)?;
        disk::before(Operation::Write(file.path(), contents))?;
        file.write_all(contents)?;
        system::make_readable(file.as_file())?;
        disk::before(Operation::Rename(file.path(), path))?;
        file.persist(path).map_err(|error| error.error)
    };
    written().map(drop).at("write", path)
}
