//! Linux, macOS and their like: process groups, signals, modes of files.

use std::fs::{File, Permissions};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus};

use rustix::process::{Pid, Signal, kill_process_group};

use super::Ending;

/// Starts the program in a process group of its own, which can be ended as one.
pub fn own_group(command: &mut Command) {
    command.process_group(0);
}

/// Ends all processes of the child's group.
pub fn kill_group(child: &Child) {
    if let Some(pid) = pid(child) {
        kill_process_group(pid, Signal::KILL).ok();
    }
}

/// How a process ended.
pub fn ending(status: ExitStatus) -> Ending {
    match status.code() {
        Some(code) => Ending::Code(code),
        None => Ending::Signal(status.signal().unwrap_or(0)),
    }
}

/// Lets everybody read a file who may read its folder: temporary ones are for their owner only.
pub fn readable_by_all(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o644))
}

pub(super) fn pid(child: &Child) -> Option<Pid> {
    Pid::from_raw(i32::try_from(child.id()).ok()?)
}
