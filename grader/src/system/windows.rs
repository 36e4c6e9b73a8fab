//! Windows: no process groups, no signals, and files inherit who may read them.

use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Child, Command, ExitStatus};

use super::Ending;

/// Nothing: there are no process groups.
pub fn own_group(_: &mut Command) {}

/// Nothing: the child alone is ended by whoever started it.
pub fn kill_group(_: &Child) {}

/// How a process ended. A crash is an exit code too, far below zero.
pub fn ending(status: ExitStatus) -> Ending {
    Ending::Code(status.code().unwrap_or(-1))
}

/// Nothing: a file inherits its folder's readers.
pub fn readable_by_all(_: &File) -> io::Result<()> {
    Ok(())
}

/// Nothing: what may be run is said by a file's name.
pub fn runnable_by_all(_: &File) -> io::Result<()> {
    Ok(())
}

/// Makes a symbolic link at `path`.
pub fn link(original: &Path, path: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_file(original, path)
}

/// Opens a regular file. Nobody is kept apart here who could put something else in its place.
pub fn open_regular(path: &Path) -> io::Result<Option<File>> {
    let file = File::open(path)?;
    Ok(file.metadata()?.is_file().then_some(file))
}

/// Nothing: a folder inherits its readers.
pub fn open_to_all(_: &Path) -> io::Result<()> {
    Ok(())
}
