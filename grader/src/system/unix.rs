//! Linux, macOS and their like: process groups, signals, modes of files.

use std::fs::{File, Permissions};
use std::io;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus};

use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;
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

/// Lets everybody run a program who can reach it.
pub fn runnable_by_all(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o755))
}

/// Lets everybody look into a folder.
pub fn open_to_all(folder: &Path) -> io::Result<()> {
    std::fs::set_permissions(folder, Permissions::from_mode(0o755))
}

/// Makes a symbolic link at `path`.
pub fn link(original: &Path, path: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(original, path)
}

/// Opens a regular file that has one name, in one step: what else lies there is never followed,
/// waited for, or changed between a look and the opening. `None` if it is something else.
pub fn open_regular(path: &Path) -> io::Result<Option<File>> {
    let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC | OFlags::RDONLY;
    let file = match rustix::fs::open(path, flags, Mode::empty()) {
        Ok(file) => File::from(file),
        Err(Errno::LOOP) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let metadata = file.metadata()?;
    Ok((metadata.is_file() && metadata.nlink() == 1).then_some(file))
}

pub(super) fn pid(child: &Child) -> Option<Pid> {
    Pid::from_raw(i32::try_from(child.id()).ok()?)
}
