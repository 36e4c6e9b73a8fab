//! Windows: no process groups, no signals, and files inherit who may read them.

use std::fs::File;
use std::io;
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
