//! Linux, macOS and other Unix systems: process groups, signals and file modes.

use std::ffi::{OsStr, OsString};
use std::fs::{File, Permissions};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};

use rustix::fs::{AtFlags, Dir, FileType, Mode, OFlags, openat, statat};
use rustix::io::Errno;
use rustix::process::{Pid, Signal, kill_process_group};

use super::{EntryKind, ExitReason, single_name};

/// Makes the command start in its own process group, so that the entire group can be killed.
pub fn use_own_process_group(command: &mut Command) {
    command.process_group(0);
}

/// Returns a command that runs `program` in its own process group and kills the group when its
/// standard input closes. The caller keeps the other end of that pipe open, so the group ends with
/// the caller, even if the caller is killed.
pub fn command_killed_at_eof(program: &Path) -> Command {
    // Discard the shell's messages about the processes it kills.
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

/// Kills all processes in the child's process group.
pub fn kill_group(child: &Child) {
    if let Some(pid) = pid(child) {
        kill_process_group(pid, Signal::KILL).ok();
    }
}

/// Returns the reason a process ended.
pub fn exit_reason(status: ExitStatus) -> ExitReason {
    match status.code() {
        Some(code) => ExitReason::Code(code),
        None => ExitReason::Signal(status.signal().unwrap_or(0)),
    }
}

/// Makes a file readable by everyone. By default, temporary files are only readable by their owner.
pub fn make_readable(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o644))
}

/// Makes a file executable by everyone.
pub fn make_executable(file: &File) -> io::Result<()> {
    file.set_permissions(Permissions::from_mode(0o755))
}

/// Lets everyone list and enter a folder.
pub fn make_folder_accessible(folder: &Path) -> io::Result<()> {
    std::fs::set_permissions(folder, Permissions::from_mode(0o755))
}

/// Creates a symbolic link at `path` that points to `original`.
pub fn symlink(original: &Path, path: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(original, path)
}

/// Opens a regular file that has only one hard link. Returns `None` for anything else.
pub fn open_file_without_hard_links(path: &Path) -> io::Result<Option<File>> {
    let Some(file) = open_regular_file(path)? else {
        return Ok(None);
    };
    let has_one_name = file.metadata()?.nlink() == 1;
    Ok(has_one_name.then_some(file))
}

/// Opens a regular file without following a symbolic link or waiting for a pipe. Returns `None` for
/// anything else. Links in the path to its folder are followed. See [`Folder`].
pub fn open_regular_file(path: &Path) -> io::Result<Option<File>> {
    regular_file(rustix::fs::open(path, FILE_FLAGS, Mode::empty()))
}

const FILE_FLAGS: OFlags = OFlags::RDONLY
    .union(OFlags::NOFOLLOW)
    .union(OFlags::NONBLOCK)
    .union(OFlags::CLOEXEC);
const FOLDER_FLAGS: OFlags = OFlags::RDONLY
    .union(OFlags::DIRECTORY)
    .union(OFlags::CLOEXEC);

/// Returns the opened file if it is a regular file. The type is checked after opening, so that
/// nobody can replace the file in between.
fn regular_file(opened: rustix::io::Result<OwnedFd>) -> io::Result<Option<File>> {
    let file = match opened {
        Ok(file) => File::from(file),
        // The path leads to a symbolic link or a socket.
        Err(Errno::LOOP | Errno::NXIO) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let is_file = file.metadata()?.is_file();
    Ok(is_file.then_some(file))
}

/// An open folder. Its contents are opened relative to it, and links are never followed, so nothing
/// outside it can be reached.
#[derive(Debug)]
pub struct Folder(OwnedFd);

impl Folder {
    /// Opens a folder named by the user. The path itself may contain links.
    pub fn open(path: &Path) -> io::Result<Self> {
        let folder = rustix::fs::open(path, FOLDER_FLAGS, Mode::empty())?;
        Ok(Folder(folder))
    }

    /// Opens a subfolder. Returns `None` if the entry with this name isn't a folder.
    pub fn subfolder(&self, name: &OsStr) -> io::Result<Option<Self>> {
        let flags = FOLDER_FLAGS | OFlags::NOFOLLOW;
        match rustix::fs::openat(&self.0, single_name(name)?, flags, Mode::empty()) {
            Ok(folder) => Ok(Some(Folder(folder))),
            // A link, or not a folder.
            Err(Errno::LOOP | Errno::NOTDIR) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Opens a regular file, like [`open_regular_file`].
    pub fn file(&self, name: &OsStr) -> io::Result<Option<File>> {
        regular_file(openat(
            &self.0,
            single_name(name)?,
            FILE_FLAGS,
            Mode::empty(),
        ))
    }

    /// Returns the kind of the entry with this name.
    pub fn kind(&self, name: &OsStr) -> io::Result<EntryKind> {
        let stat = statat(&self.0, single_name(name)?, AtFlags::SYMLINK_NOFOLLOW)?;
        let kind = FileType::from_raw_mode(stat.st_mode);
        Ok(if kind.is_file() {
            EntryKind::File
        } else if kind.is_dir() {
            EntryKind::Folder
        } else if kind.is_symlink() {
            EntryKind::Link
        } else {
            EntryKind::Other
        })
    }

    /// Returns the names of the entries, sorted.
    pub fn names(&self) -> io::Result<Vec<OsString>> {
        let mut names = Vec::new();
        for entry in Dir::read_from(&self.0)? {
            let entry = entry?;
            let name = OsStr::from_bytes(entry.file_name().to_bytes());
            if name != "." && name != ".." {
                names.push(name.to_owned());
            }
        }
        names.sort();
        Ok(names)
    }
}

/// Returns the free space on a folder's disk, in bytes, if the system reports it.
pub fn free_space(folder: &Path) -> Option<u64> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    Some(disk.f_bavail.saturating_mul(disk.f_frsize))
}

pub(super) fn pid(child: &Child) -> Option<Pid> {
    Pid::from_raw(i32::try_from(child.id()).ok()?)
}
