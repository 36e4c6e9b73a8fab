//! Copies a file from a folder that cannot be trusted, because a submission's compiler could write
//! to it.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek};
use std::path::{Path, PathBuf};

use crate::machine::system;

/// Maximum size of a program, in bytes. The reference's program is about 6 MB.
pub(super) const MAX_BYTES: u64 = 64 << 20;

/// First bytes of programs (ELF) and of libraries (`ar`).
const MAGIC_NUMBERS: [&[u8]; 2] = [b"\x7fELF", b"!<arch>\n"];

/// The compiler's output.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum OutputFile {
    /// The path of a program or library.
    Verified(PathBuf),
    /// The file is too large: it has this many bytes.
    TooLarge(u64),
    /// The file is missing, or it isn't a regular file that begins like a program or library.
    Missing,
}

/// Checks a file's size and leaves the file in place.
pub(super) fn check_size(path: PathBuf) -> io::Result<OutputFile> {
    Ok(match fs::metadata(&path) {
        Ok(file) if !file.is_file() => OutputFile::Missing,
        Ok(file) if file.len() > MAX_BYTES => OutputFile::TooLarge(file.len()),
        Ok(_) => OutputFile::Verified(path),
        Err(error) if error.kind() == io::ErrorKind::NotFound => OutputFile::Missing,
        Err(error) => return Err(error),
    })
}

/// Copies a file from `folder` to a folder that only the grader can write to. Returns the path of
/// the copy.
pub(super) fn copy_verified(folder: &Path, name: &str) -> io::Result<OutputFile> {
    let Some(made) = open_regular(&folder.join(name))? else {
        return Ok(OutputFile::Missing);
    };
    let length = made.metadata()?.len();
    if length > MAX_BYTES {
        return Ok(OutputFile::TooLarge(length));
    }
    let Some(made) = with_magic_number(made)? else {
        return Ok(OutputFile::Missing);
    };
    let folder_of_copy = folder.with_extension("made");
    fs::create_dir_all(&folder_of_copy)?;
    let path = folder_of_copy.join(name);
    let mut copy = OpenOptions::new();
    let mut copy = copy.write(true).create_new(true).open(&path)?;
    io::copy(&mut made.take(MAX_BYTES), &mut copy)?;
    system::make_executable(&copy)?;
    Ok(OutputFile::Verified(path))
}

fn open_regular(path: &Path) -> io::Result<Option<File>> {
    match system::open_file_without_hard_links(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        opened => opened,
    }
}

/// Returns the file if it begins like a program or library.
fn with_magic_number(mut file: File) -> io::Result<Option<File>> {
    let mut first_bytes = [0; 8];
    if file.read_exact(&mut first_bytes).is_err() {
        return Ok(None);
    }
    let is_known = MAGIC_NUMBERS
        .iter()
        .any(|known| first_bytes.starts_with(known));
    file.rewind()?;
    Ok(is_known.then_some(file))
}
