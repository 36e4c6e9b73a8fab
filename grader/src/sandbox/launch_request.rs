//! What the launcher is told, and how: in its arguments, before the program that it starts.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::sandbox::isolation::Isolation;
use crate::system::Limits;

/// The first argument of a program of ours that is to be the launcher.
pub(super) const LAUNCH_FLAG: &str = "--launch-confined";

/// What the launcher writes to standard output when all is in place: from the next byte on, it is
/// the confined program that writes. Without it, the fault is ours.
pub(super) const READY: u8 = b'+';

/// What a program is allowed. Everything else is refused.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Profile {
    /// A submission's own program: computes, and speaks through the pipes that it was given. No
    /// file, no socket, no process. It has to be linked statically.
    Probe,
    /// The compiler and the linker that it starts.
    Compiler {
        /// The files and folders that they may read and run.
        readable: Vec<PathBuf>,
        /// The folder that they may write in.
        writable: PathBuf,
    },
}

/// One start.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LaunchRequest {
    /// What has to be in place; nothing less will do.
    pub(super) level: Isolation,
    /// The process that starts it, at whose end it ends.
    pub(super) grader: u32,
    /// What is allowed.
    pub(super) profile: Profile,
    /// What may be used.
    pub(super) limits: Limits,
}
