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

/// The same as [`open_file`].
pub fn open_regular(path: &Path) -> io::Result<Option<File>> {
    open_file(path)
}

/// Opens a regular file. Links need rights here that students do not have.
pub fn open_file(path: &Path) -> io::Result<Option<File>> {
    // Not all that is there can be opened.
    if !path.symlink_metadata()?.is_file() {
        return Ok(None);
    }
    let file = File::open(path)?;
    Ok(file.metadata()?.is_file().then_some(file))
}

/// Nothing: a folder inherits its readers.
pub fn open_to_all(_: &Path) -> io::Result<()> {
    Ok(())
}

/// Not told.
pub fn free_space(_: &Path) -> Option<u64> {
    None
}

/// A command for the program, which nothing ends but itself.
pub fn tied(program: &Path) -> Command {
    Command::new(program)
}
