//! What differs between operating systems, and nothing else: all of the grader's `cfg` stands here.
//!
//! Each system has the same functions. Where a system can not do a thing, its function does
//! nothing, and says so.

use std::process::Command;
use std::time::Duration;

use serde::{Deserialize, Serialize};

#[cfg(target_os = "linux")]
mod linux;
#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(target_os = "linux")]
pub use linux::{cpu_time, memory, set_limits};
#[cfg(unix)]
pub use unix::{
    command_killed_at_eof, exit_reason, free_space, kill_group, make_executable,
    make_folder_accessible, make_readable, open_file_without_hard_links, open_regular_file,
    symlink, use_own_process_group,
};
#[cfg(windows)]
pub use windows::{
    ending, free_space, kill_group, link, open_file, open_regular, open_to_all, own_group,
    readable_by_all, runnable_by_all, tied,
};

/// What a process may use. Where the system knows no such limit, wall time is the only one.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Limits {
    /// Address space, in bytes.
    pub memory: u64,
    /// CPU time of the process over its whole life.
    pub cpu: Duration,
    /// The largest file that it may write, in bytes.
    pub file: u64,
}

/// How many seconds of CPU time a process may ignore that its time is over, before it is killed.
#[cfg(target_os = "linux")]
pub(crate) const CPU_GRACE_SECONDS: u64 = 1;

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExitReason {
    /// By itself, with this exit code.
    Code(i32),
    /// By this signal.
    Signal(i32),
}

/// What no program can do without: Windows' own libraries, and the linker, look these up. macOS is
/// asked where its linker's files lie.
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
    // Set where somebody chose a linker by hand.
    "VCINSTALLDIR",
    "INCLUDE",
    "LIB",
    "LIBPATH",
    "DEVELOPER_DIR",
    "SDKROOT",
];

/// Takes away all of the environment but what the system can not do without.
pub fn clear_environment(command: &mut Command) {
    command.env_clear();
    // On Linux an empty environment is enough, and the same for everyone.
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

/// No limits: `setrlimit` is for oneself only, and jobs are not for safe code.
#[cfg(not(target_os = "linux"))]
pub fn limit(_: &std::process::Child, _: Limits) -> std::io::Result<()> {
    Ok(())
}

/// Not told.
#[cfg(not(target_os = "linux"))]
pub fn cpu_time(_: &std::process::Child) -> Option<Duration> {
    None
}

/// Not told.
#[cfg(not(target_os = "linux"))]
pub fn memory(_: &std::process::Child) -> Option<u64> {
    None
}
