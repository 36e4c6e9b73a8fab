//! Windows, where files inherit their permissions, and where process groups and signals don't
//! exist.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};

use super::{EntryKind, ExitReason, single_name};

/// Does nothing, since Windows doesn't support process groups.
pub fn use_own_process_group(_: &mut Command) {}

/// Does nothing: the caller only kills the child itself.
pub fn kill_group(_: &Child) {}

/// Returns the reason a process ended. A crash also results in an exit code, which is a large
/// negative number.
pub fn exit_reason(status: ExitStatus) -> ExitReason {
    ExitReason::Code(status.code().unwrap_or(-1))
}

/// Does nothing: a file inherits its folder's permissions.
pub fn make_readable(_: &File) -> io::Result<()> {
    Ok(())
}

/// Does nothing: whether a file is executable depends on its extension.
pub fn make_executable(_: &File) -> io::Result<()> {
    Ok(())
}

/// Creates a symbolic link at `path` that points to `original`.
pub fn symlink(original: &Path, path: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_file(original, path)
}

/// Opens a regular file, like [`open_regular_file`]. Hard links aren't checked.
pub fn open_file_without_hard_links(path: &Path) -> io::Result<Option<File>> {
    open_regular_file(path)
}

/// Opens a regular file. Returns `None` for anything else. A symbolic link that replaced the file
/// after the check would be followed, but on Windows, creating one needs privileges that students
/// don't have.
pub fn open_regular_file(path: &Path) -> io::Result<Option<File>> {
    // Check the type first, because opening anything else may fail.
    if !path.symlink_metadata()?.is_file() {
        return Ok(None);
    }
    let file = File::open(path)?;
    Ok(file.metadata()?.is_file().then_some(file))
}

/// An open folder. Links in it, including junctions, are never followed.
#[derive(Debug)]
pub struct Folder(PathBuf);

impl Folder {
    /// Opens a folder named by the user. The path itself may contain links.
    pub fn open(path: &Path) -> io::Result<Self> {
        path.read_dir()?;
        Ok(Folder(path.to_owned()))
    }

    /// Opens a subfolder. Returns `None` if the entry with this name isn't a folder.
    pub fn subfolder(&self, name: &OsStr) -> io::Result<Option<Self>> {
        let is_folder = self.kind(name)? == EntryKind::Folder;
        Ok(is_folder.then(|| Folder(self.0.join(name))))
    }

    /// Opens a regular file, like [`open_regular_file`].
    pub fn file(&self, name: &OsStr) -> io::Result<Option<File>> {
        open_regular_file(&self.0.join(single_name(name)?))
    }

    /// Returns the kind of the entry with this name.
    pub fn kind(&self, name: &OsStr) -> io::Result<EntryKind> {
        let kind = self
            .0
            .join(single_name(name)?)
            .symlink_metadata()?
            .file_type();
        Ok(if kind.is_symlink() {
            EntryKind::Link
        } else if kind.is_dir() {
            EntryKind::Folder
        } else if kind.is_file() {
            EntryKind::File
        } else {
            EntryKind::Other
        })
    }

    /// Returns the names of the entries, sorted.
    pub fn names(&self) -> io::Result<Vec<OsString>> {
        let names = self.0.read_dir()?.map(|entry| Ok(entry?.file_name()));
        let mut names: Vec<OsString> = names.collect::<io::Result<_>>()?;
        names.sort();
        Ok(names)
    }
}

/// Does nothing: a folder inherits its permissions.
pub fn make_folder_accessible(_: &Path) -> io::Result<()> {
    Ok(())
}

/// Returns `None`: free space isn't available on this system.
pub fn free_space(_: &Path) -> Option<u64> {
    None
}

/// Returns a command that runs `program`. It isn't killed when its standard input closes.
pub fn command_killed_at_eof(program: &Path) -> Command {
    Command::new(program)
}
