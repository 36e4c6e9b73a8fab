//! A disk with faults, and with a switch that turns the process off.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use grader::disk::{self, Disk, Operation};

/// A fault of the disk. The numbers count the operations of a step, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiskFault {
    /// Nothing.
    None,
    /// The process is killed during an operation: this one may be half done, and no later one happens.
    KilledAt(u64),
    /// From this operation on, nothing can be written.
    FullFrom(u64),
    /// The first file written from this operation on cannot be written.
    WriteErrorAt(u64),
    /// The first file or folder read from this operation on cannot be read.
    ReadErrorAt(u64),
}

#[derive(Debug)]
struct State {
    /// Only operations in this folder are counted and fail.
    root: PathBuf,
    fault: DiskFault,
    count: u64,
    is_done: bool,
}

/// The disk of this process.
#[derive(Debug)]
pub struct FaultyDisk(Mutex<State>);

static DISK: FaultyDisk = FaultyDisk(Mutex::new(State {
    root: PathBuf::new(),
    fault: DiskFault::None,
    count: 0,
    is_done: false,
}));

const NO_SPACE: i32 = 28;
const INPUT_OUTPUT: i32 = 5;

/// Installs the disk. It has no faults until [`start`] is called.
pub fn install() {
    assert!(disk::install(&DISK), "no other disk is installed");
}

/// Plans the faults of a step.
pub fn start(root: &Path, fault: DiskFault) {
    *DISK.0.lock().unwrap() = State {
        root: root.to_owned(),
        fault,
        count: 0,
        is_done: false,
    };
}

/// Ends the faults. Returns the number of operations of the step, and whether a fault occurred.
pub fn stop() -> (u64, bool) {
    let mut state = DISK.0.lock().unwrap();
    state.fault = DiskFault::None;
    (state.count, state.is_done)
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
        state.count += 1;
        let needs_space = matches!(
            operation,
            Operation::CreateFolder(_) | Operation::CreateTemporary(_) | Operation::Write(..)
        );
        let (count, is_first) = (state.count, !state.is_done);
        let error = match state.fault {
            DiskFault::KilledAt(at) if count >= at => {
                if is_first {
                    leave_half(operation);
                }
                Some(INPUT_OUTPUT)
            }
            DiskFault::FullFrom(at) if count >= at && needs_space => Some(NO_SPACE),
            DiskFault::WriteErrorAt(at) if count >= at && !is_read && is_first => {
                Some(INPUT_OUTPUT)
            }
            DiskFault::ReadErrorAt(at) if count >= at && is_read && is_first => Some(INPUT_OUTPUT),
            DiskFault::None
            | DiskFault::KilledAt(_)
            | DiskFault::FullFrom(_)
            | DiskFault::WriteErrorAt(_)
            | DiskFault::ReadErrorAt(_) => None,
        };
        state.is_done |= error.is_some();
        error.map_or(Ok(()), |code| Err(io::Error::from_raw_os_error(code)))
    }
}

/// Leaves what an operation leaves if the process is killed while it happens. Temporary files get
/// another name, because a process that is not really killed removes its own.
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
