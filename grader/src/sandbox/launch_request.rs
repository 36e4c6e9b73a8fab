//! The request that the grader passes to the launcher as an argument, before the program to start.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::machine::system::Limits;
use crate::sandbox::isolation::Isolation;

/// The first argument of a process that should run as the launcher.
pub(super) const LAUNCH_FLAG: &str = "--launch-confined";

/// The byte that the launcher writes to standard output once the sandbox is in place. All further
/// output comes from the confined program. If the byte is missing, it was the launcher that failed,
/// not the program.
pub(super) const READY: u8 = b'+';

/// The system access granted to a program. All other access is denied.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Profile {
    /// A submission's program, which computes and communicates through the pipes it inherits. It
    /// may not open files or sockets or start processes, so it must be linked statically.
    Probe,
    /// The compiler and the linker it starts.
    Compiler {
        /// The files and folders that the compiler and the linker may read and execute.
        readable: Vec<PathBuf>,
        /// The folder that the compiler and the linker may write to.
        writable: PathBuf,
    },
}

/// The launcher's instructions for starting one program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LaunchRequest {
    /// The required level of isolation. If it isn't available, nothing is started.
    pub(super) level: Isolation,
    /// The grader's process id. A probe is killed when the grader ends.
    pub(super) grader: u32,
    /// The access granted to the program.
    pub(super) profile: Profile,
    /// The resource limits for the program.
    pub(super) limits: Limits,
}
