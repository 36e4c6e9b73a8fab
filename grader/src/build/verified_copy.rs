//! Taking a file from a folder that a compiler could write in while it read a submission: nothing
//! there is taken for what it seems to be.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek};
use std::path::{Path, PathBuf};

use crate::system;

/// The largest program, in bytes; honest ones have 6 million.
const MAX_BYTES: u64 = 64 << 20;

/// What made programs and libraries begin with: ELF, `ar`.
const MAGIC_NUMBERS: [&[u8]; 2] = [b"\x7fELF", b"!<arch>\n"];

/// Copies a file that was made in `folder` to one that only we can write; returns its place. `None`
/// if there is no such file, or something else in its place.
pub(super) fn copy_verified(folder: &Path, name: &str) -> io::Result<Option<PathBuf>> {
    let Some(made) = open_verified(&folder.join(name))? else {
        return Ok(None);
    };
    let ours = folder.with_extension("made");
    fs::create_dir_all(&ours)?;
    let path = ours.join(name);
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
    let mut beginning = [0; 8];
    let length = file.metadata()?.len();
    if length > MAX_BYTES || file.read_exact(&mut beginning).is_err() {
        return Ok(None);
    }
    let is_known = MAGIC_NUMBERS
        .iter()
        .any(|known| beginning.starts_with(known));
    file.rewind()?;
    Ok(is_known.then_some(file))
}
