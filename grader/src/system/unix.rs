//! Linux, macOS and their like: process groups, signals, modes of files.

use std::fs::{File, Permissions};
use std::io;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};

use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;
use rustix::process::{Pid, Signal, kill_process_group};

use super::ExitReason;

/// Starts the program in a process group of its own, which can be ended as one.
pub fn use_own_process_group(command: &mut Command) {
    command.process_group(0);
}

/// A command for a program that starts others, all of which end when its standard input does: so
/// does what holds the other end, however it ends. That is for whoever starts it to hold.
pub fn command_killed_at_eof(program: &Path) -> Command {
    // The shell's own words about what it ends are of no interest.
    const SCRIPT: &str = r#"
        exec 3<&0
        { read -r _ <&3; kill -KILL 0; } >/dev/null 2>&1 &
        "$@" </dev/null 3<&-
        code=$?
        exec 2>/dev/null
        kill -KILL $!
        exit $code"#;
    let mut command = Command::new("/bin/sh");
    command.args(["-c", SCRIPT, "sh"]).arg(program);
    command.process_group(0).stdin(Stdio::piped());
    command
}

/// Ends all processes of the child's group.
pub fn kill_group(child: &Child) {
    if let Some(pid) = pid(child) {
        kill_process_group(pid, Signal::KILL).ok();
    }
}

/// How a process ended.
pub fn exit_reason(status: ExitStatus) -> ExitReason {
    match status.code() {
        Some(code) => ExitReason::Code(code),
        None => ExitReason::Signal(status.signal().unwrap_or(0)),
    }
}

/// Lets everybody read a file who may read its folder: temporary ones are for their owner only.
pub fn make_readable(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o644))
}

/// Lets everybody run a program who can reach it.
pub fn make_executable(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o755))
}

/// Lets everybody look into a folder.
pub fn make_folder_accessible(folder: &Path) -> io::Result<()> {
    std::fs::set_permissions(folder, Permissions::from_mode(0o755))
}

/// Makes a symbolic link at `path`.
pub fn symlink(original: &Path, path: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(original, path)
}

/// Opens a regular file that has one name. `None` if it is something else.
pub fn open_file_without_hard_links(path: &Path) -> io::Result<Option<File>> {
    let Some(file) = open_regular_file(path)? else {
        return Ok(None);
    };
    let has_one_name = file.metadata()?.nlink() == 1;
    Ok(has_one_name.then_some(file))
}

/// Opens a regular file in one step: what else lies there is never followed, waited for, or changed
/// between a look and the opening. `None` if it is something else.
pub fn open_regular_file(path: &Path) -> io::Result<Option<File>> {
    let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC | OFlags::RDONLY;
    let file = match rustix::fs::open(path, flags, Mode::empty()) {
        Ok(file) => File::from(file),
        // A link; a socket.
        Err(Errno::LOOP | Errno::NXIO) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let is_file = file.metadata()?.is_file();
    Ok(is_file.then_some(file))
}

/// The room that is left on the disk of a folder, in bytes, if the system tells it.
pub fn free_space(folder: &Path) -> Option<u64> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    Some(disk.f_bavail.saturating_mul(disk.f_frsize))
}

pub(super) fn pid(child: &Child) -> Option<Pid> {
    Pid::from_raw(i32::try_from(child.id()).ok()?)
}
