//! The interface between the grader and the disk. An installed [`Disk`] is called before every
//! operation on the files of submissions, reports and classes, and can make the operation fail.
//! Tests install disks that are full, or that fail every operation from some point on, as if the
//! process had been killed. Outside tests, no disk is installed.
//!
//! The disk isn't called for files used by the compiler, its sandbox or the probes. Compilers and
//! probes run in separate processes, so tests make these processes fail instead.

use std::io;
use std::path::Path;
use std::sync::OnceLock;

/// An operation on a file or a folder.
#[derive(Clone, Copy, Debug)]
pub enum Operation<'a> {
    /// Reads a file.
    Read(&'a Path),
    /// Lists a folder.
    List(&'a Path),
    /// Creates a folder and its parents.
    CreateFolder(&'a Path),
    /// Creates an empty file with a temporary name in a folder.
    CreateTemporary(&'a Path),
    /// Writes the contents of a file. If the operation is interrupted, only part of the contents
    /// may have been written.
    Write(&'a Path, &'a [u8]),
    /// Renames a complete file to its final name.
    Rename(&'a Path, &'a Path),
    /// Removes a file.
    Remove(&'a Path),
}

/// Decides whether operations succeed.
pub trait Disk: Send + Sync {
    /// Called before an operation. If this returns an error, the operation is skipped and fails
    /// with this error.
    fn before(&self, operation: Operation) -> io::Result<()>;
}

static INSTALLED: OnceLock<&'static dyn Disk> = OnceLock::new();

/// Installs a disk for the rest of this process. If a disk has already been installed, ignores the
/// new one and returns `false`.
pub fn install(disk: &'static dyn Disk) -> bool {
    INSTALLED.set(disk).is_ok()
}

/// Calls the installed disk, if any, before an operation.
pub fn before(operation: Operation) -> io::Result<()> {
    INSTALLED
        .get()
        .map_or(Ok(()), |disk| disk.before(operation))
}
