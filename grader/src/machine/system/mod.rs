//! Functions whose implementations differ between operating systems.
//!
//! The functions' names and types are the same on every system. A function that a system doesn't
//! support does nothing or returns `None` there, as documented.

use std::ffi::OsStr;
use std::io;
use std::path::{Component, Path};
use std::process::Command;
use std::time::Duration;

use serde::{Deserialize, Serialize};

#[cfg(target_os = "linux")]
mod available_memory;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(target_os = "linux")]
pub use available_memory::available_memory;
#[cfg(target_os = "linux")]
pub use linux::{
    cpu_time, cpu_time_with_children, memory, process_time, resources, rlimit, set_limits,
};
#[cfg(unix)]
pub use unix::{
    Folder, command_killed_at_eof, exit_reason, free_space, kill_group, make_executable,
    make_folder_accessible, make_readable, open_file_without_hard_links, open_regular_file,
    symlink, use_own_process_group,
};
#[cfg(windows)]
pub use windows::{
    Folder, command_killed_at_eof, exit_reason, free_space, kill_group, make_executable,
    make_folder_accessible, make_readable, open_file_without_hard_links, open_regular_file,
    symlink, use_own_process_group,
};

/// Resource limits of a process. On a system without such limits, only wall time is limited.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Limits {
    /// Address space, in bytes.
    pub memory: u64,
    /// Memory that the process itself fills, in bytes: its heap, stacks and variables, but not the
    /// files that it maps. `None` means that only the address space is limited.
    pub data: Option<u64>,
    /// Total CPU time of the process.
    pub cpu: Duration,
    /// Maximum size of a file that the process may write, in bytes.
    pub file: u64,
}

/// How a process has used its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProcessTime {
    /// CPU time.
    pub cpu: Duration,
    /// Time during which the process was ready to run but other processes occupied the processors.
    /// The system adds it only when the process gets a processor.
    pub delayed: Duration,
    /// Whether the process isn't running, isn't ready to run and isn't being served by the system.
    pub is_asleep: bool,
}

impl Limits {
    /// Part of the available memory that is left for the rest of the system, in bytes.
    const RESERVE: u64 = 64 << 20;

    /// Lowers the memory limit to the machine's available memory, so that a process that uses too
    /// much exceeds its own limit before the system kills a process. `needed` is the memory that a
    /// correct process may need. The limit is never lowered below `needed`.
    pub fn within_available_memory(self, needed: u64) -> Self {
        let left = available_memory().map(|bytes| bytes.saturating_sub(Self::RESERVE));
        Limits {
            data: left.map(|bytes| bytes.clamp(needed, self.memory)),
            ..self
        }
    }
}

/// The kind of an entry in a [`Folder`]. Links aren't followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
    /// A symbolic link, or a junction.
    Link,
    /// A pipe, a socket or a device.
    Other,
}

/// Returns `name` if it is the name of a single entry, rather than a path with several components
/// or `..`.
#[cfg(any(unix, windows))]
fn single_name(name: &OsStr) -> io::Result<&OsStr> {
    let mut parts = Path::new(name).components();
    match (parts.next(), parts.next()) {
        (Some(Component::Normal(part)), None) if part == name => Ok(name),
        _ => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "expected the name of a file or folder, not a path",
        )),
    }
}

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExitReason {
    /// The process exited with this code.
    Code(i32),
    /// The process was ended by this signal.
    Signal(i32),
}

/// Environment variables that programs cannot do without. On Windows, the system's libraries and
/// the linker look them up. On macOS, they contain the location of the linker's files.
const REQUIRED_VARIABLES: [&str; 16] = [
    "SystemRoot",
    "SystemDrive",
    "windir",
    "ComSpec",
    "PATHEXT",
    "TEMP",
    "TMP",
    "ProgramData",
    "ProgramFiles",
    "ProgramFiles(x86)",
    // These are set if the user has chosen a linker.
    "VCINSTALLDIR",
    "INCLUDE",
    "LIB",
    "LIBPATH",
    "DEVELOPER_DIR",
    "SDKROOT",
];

/// Removes all environment variables except those that programs on this system cannot do without.
pub fn clear_environment(command: &mut Command) {
    command.env_clear();
    // On Linux, an empty environment is enough, and it is the same on every machine.
    if cfg!(target_os = "linux") {
        return;
    }
    let kept = REQUIRED_VARIABLES.map(|name| (name, std::env::var_os(name)));
    for (name, value) in kept {
        if let Some(value) = value {
            command.env(name, value);
        }
    }
}

/// Keeps the PATH in the environment of a compiler on Windows, where the compiler may need it to
/// find the linker. On other systems, the compiler gets the linker's path as an argument.
pub fn keep_search_path(command: &mut Command) {
    if let Some(path) = std::env::var_os("PATH").filter(|_| cfg!(windows)) {
        command.env("PATH", path);
    }
}

/// Does nothing: `setrlimit` only limits the calling process, and Windows job objects cannot be
/// used from safe code.
#[cfg(not(target_os = "linux"))]
pub fn set_limits(_: &std::process::Child, _: Limits) -> std::io::Result<()> {
    Ok(())
}

/// Returns `None`, since a process's CPU time isn't available on this system.
#[cfg(not(target_os = "linux"))]
pub fn cpu_time(_: &std::process::Child) -> Option<Duration> {
    None
}

/// Returns `None`, since a process's CPU time isn't available on this system.
#[cfg(not(target_os = "linux"))]
pub fn cpu_time_with_children(_: &std::process::Child) -> Option<Duration> {
    None
}

/// Returns `None`, since this system doesn't report the available memory.
#[cfg(not(target_os = "linux"))]
pub fn available_memory() -> Option<u64> {
    None
}

/// Returns `None`, since this system doesn't report how a process uses its time.
#[cfg(not(target_os = "linux"))]
pub fn process_time(_: &std::process::Child) -> Option<ProcessTime> {
    None
}

/// Returns `None`, since a process's memory use isn't available on this system.
#[cfg(not(target_os = "linux"))]
pub fn memory(_: &std::process::Child) -> Option<u64> {
    None
}
