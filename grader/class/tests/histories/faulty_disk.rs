//! A simulated disk that can fail or kill the process.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use grader::disk::{self, Disk, Operation};

/// A disk fault. The number in a variant says which of a step's operations is affected, counting
/// from 1. `ReadErrorAt` only counts reads, and the other variants only count changes. A process is
/// never killed during a read, because that would leave the same files as killing it before the
/// next change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiskFault {
    /// No fault.
    None,
    /// The process is killed during this change. The change may be half done, and no later change
    /// happens.
    KilledAt(u64),
    /// From this change on, nothing can be written.
    FullFrom(u64),
    /// This change fails.
    WriteErrorAt(u64),
    /// This read fails.
    ReadErrorAt(u64),
}

/// Operation counts.
#[derive(Clone, Copy, Debug)]
pub struct Operations {
    /// Operations that change something.
    pub changes: u64,
    /// Operations that read a file or list a folder.
    pub reads: u64,
}

impl Operations {
    const NONE: Self = Operations {
        changes: 0,
        reads: 0,
    };
}

#[derive(Debug)]
struct State {
    /// Only operations in this folder are counted and can fail.
    root: PathBuf,
    fault: DiskFault,
    done: Operations,
    had_fault: bool,
}

/// The disk of this process.
#[derive(Debug)]
pub struct FaultyDisk(Mutex<State>);

static DISK: FaultyDisk = FaultyDisk(Mutex::new(State {
    root: PathBuf::new(),
    fault: DiskFault::None,
    done: Operations::NONE,
    had_fault: false,
}));

const NO_SPACE: i32 = 28;
const INPUT_OUTPUT: i32 = 5;

/// Installs the disk. Nothing fails until [`start`] is called.
pub fn install() {
    assert!(disk::install(&DISK), "no other disk is installed");
}

/// Schedules the fault for a step.
pub fn start(root: &Path, fault: DiskFault) {
    *DISK.0.lock().unwrap() = State {
        root: root.to_owned(),
        fault,
        done: Operations::NONE,
        had_fault: false,
    };
}

/// Stops simulating faults. Returns the step's operation counts and whether a fault occurred.
pub fn stop() -> (Operations, bool) {
    let mut state = DISK.0.lock().unwrap();
    state.fault = DiskFault::None;
    (state.done, state.had_fault)
}

impl Disk for FaultyDisk {
    fn before(&self, operation: Operation) -> io::Result<()> {
        let mut state = self.0.lock().unwrap();
        let (path, is_read) = match operation {
            Operation::Read(path) | Operation::List(path) => (path, true),
            Operation::CreateFolder(path)
            | Operation::CreateTemporary(path)
            | Operation::Write(path, _)
            | Operation::Rename(path, _)
            | Operation::Remove(path) => (path, false),
        };
        if !path.starts_with(&state.root) {
            return Ok(());
        }
        let needs_space = matches!(
            operation,
            Operation::CreateFolder(_) | Operation::CreateTemporary(_) | Operation::Write(..)
        );
        if is_read {
            state.done.reads += 1;
        } else {
            state.done.changes += 1;
        }
        let Operations { changes, reads } = state.done;
        let error = match state.fault {
            DiskFault::KilledAt(at) if changes >= at => {
                if !state.had_fault {
                    leave_half(operation);
                }
                Some(INPUT_OUTPUT)
            }
            DiskFault::FullFrom(at) if changes >= at && needs_space => Some(NO_SPACE),
            DiskFault::WriteErrorAt(at) if changes == at && !is_read => Some(INPUT_OUTPUT),
            DiskFault::ReadErrorAt(at) if reads == at && is_read => Some(INPUT_OUTPUT),
            DiskFault::None
            | DiskFault::KilledAt(_)
            | DiskFault::FullFrom(_)
            | DiskFault::WriteErrorAt(_)
            | DiskFault::ReadErrorAt(_) => None,
        };
        state.had_fault |= error.is_some();
        error.map_or(Ok(()), |code| Err(io::Error::from_raw_os_error(code)))
    }
}

/// Leaves behind the files that would be left if the process were killed during the operation.
/// Temporary files are renamed, because this process isn't really killed and would remove its own.
fn leave_half(operation: Operation) {
    let left = |file: &Path, contents: &[u8]| {
        fs::write(file.with_file_name(".tmpKilled"), contents).unwrap();
    };
    match operation {
        Operation::CreateTemporary(folder) => left(&folder.join("any"), b""),
        Operation::Write(file, contents) => {
            let half = &contents[..contents.len() / 2];
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with(".tmp") {
                left(file, half);
            } else {
                fs::write(file, half).unwrap();
            }
        }
        Operation::Rename(file, _) => left(file, &fs::read(file).unwrap()),
        Operation::Read(_)
        | Operation::List(_)
        | Operation::CreateFolder(_)
        | Operation::Remove(_) => {}
    }
}
