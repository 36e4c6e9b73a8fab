//! The seam between the grader and the disk. An installed [`Disk`] is asked before every operation on
//! the files of submissions, reports and classes, and can make it fail. Tests install one that is
//! full, or that fails every operation from some point on, as if the process had been killed. Outside
//! of tests, none is installed.
//!
//! It is not asked about the files of the compiler, its sandbox and the probes: they are separate
//! processes, and a fault in them is one of a process.

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
    /// Creates a folder, and those around it.
    CreateFolder(&'a Path),
    /// Creates an empty file with a temporary name in a folder.
    CreateTemporary(&'a Path),
    /// Writes the contents of a file. If the operation is interrupted, a part of them may have been
    /// written.
    Write(&'a Path, &'a [u8]),
    /// Gives a complete file its name.
    Rename(&'a Path, &'a Path),
    /// Removes a file.
    Remove(&'a Path),
}

/// A judge of operations.
pub trait Disk: Send + Sync {
    /// Called before an operation. If this returns an error, the operation is not made, and fails
    /// with this error.
    fn before(&self, operation: Operation) -> io::Result<()>;
}

static INSTALLED: OnceLock<&'static dyn Disk> = OnceLock::new();

/// Installs a disk for the rest of this process. Returns whether it is the first one; others have no
/// effect.
pub fn install(disk: &'static dyn Disk) -> bool {
    INSTALLED.set(disk).is_ok()
}

/// Asks the installed disk, if there is one, before an operation.
pub fn before(operation: Operation) -> io::Result<()> {
    INSTALLED
        .get()
        .map_or(Ok(()), |disk| disk.before(operation))
}
