//! Copies a file from the folder that a submission's compiler could write to. Nothing in that
//! folder is trusted.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek};
use std::path::{Path, PathBuf};

use crate::system;

/// Maximum size of a program, in bytes. The reference's program has about 6 MB.
const MAX_BYTES: u64 = 64 << 20;

/// First bytes of programs (ELF) and of libraries (`ar`).
const MAGIC_NUMBERS: [&[u8]; 2] = [b"\x7fELF", b"!<arch>\n"];

/// Copies a file from `folder` to a folder that only the grader can write to, and returns the path
/// of the copy. Returns `None` if there is no such file, or if it is not a regular file that begins
/// like a program or library.
pub(super) fn copy_verified(folder: &Path, name: &str) -> io::Result<Option<PathBuf>> {
    let Some(made) = open_verified(&folder.join(name))? else {
        return Ok(None);
    };
    let folder_of_copy = folder.with_extension("made");
    fs::create_dir_all(&folder_of_copy)?;
    let path = folder_of_copy.join(name);
    let mut copy = OpenOptions::new();
    let mut copy = copy.write(true).create_new(true).open(&path)?;
    io::copy(&mut made.take(MAX_BYTES), &mut copy)?;
    system::make_executable(&copy)?;
    Ok(Some(path))
}

fn open_verified(path: &Path) -> io::Result<Option<File>> {
    let mut file = match system::open_file_without_hard_links(path) {
        Ok(Some(file)) => file,
        Ok(None) => return Ok(None),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let mut first_bytes = [0; 8];
    let length = file.metadata()?.len();
    if length > MAX_BYTES || file.read_exact(&mut first_bytes).is_err() {
        return Ok(None);
    }
    let is_known = MAGIC_NUMBERS
        .iter()
        .any(|known| first_bytes.starts_with(known));
    file.rewind()?;
    Ok(is_known.then_some(file))
}
