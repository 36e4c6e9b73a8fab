//! Runs untrusted programs under limits and ensures that they end.
//!
//! Your own work runs at level `none`: in its own process group, with an empty environment, and
//! with limits on memory and CPU time as far as the [`system`](crate::machine::system) supports
//! them. Other people's code is started by a *launcher*, which is another process of the grader's
//! own executable. It drops its privileges one by one and then executes the untrusted
//! program. The launcher only works on Linux. On other systems, `none` is the only level.
//!
//! `grader/SECURITY.md` describes what each level promises and what no level promises.

mod isolation;
mod launch_request;
#[cfg(target_os = "linux")]
mod linux;
mod process;
#[cfg(not(target_os = "linux"))]
mod unsupported;

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::machine::system::Limits;

use launch_request::{LAUNCH_FLAG, LaunchRequest};
#[cfg(target_os = "linux")]
use linux as platform;
#[cfg(not(target_os = "linux"))]
use unsupported as platform;

pub use crate::machine::system::ExitReason;
pub use isolation::Isolation;
pub use launch_request::Profile;
pub use process::Process;

/// Starts programs at one isolation level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sandbox {
    level: Isolation,
    launcher: PathBuf,
}

/// Runs this process as the launcher if it was started as one. Returns its exit code in that case,
/// otherwise `None`.
///
/// Every program that uses a [`Sandbox`] must call this first in its `main`.
pub fn run_as_launcher() -> Option<ExitCode> {
    let mut arguments = env::args_os().skip(1);
    if arguments.next()? != LAUNCH_FLAG {
        return None;
    }
    Some(platform::launch(arguments).unwrap_or_else(|error| {
        // The grader reads this from standard error, since the program itself hasn't been started.
        eprint!("{error}");
        ExitCode::FAILURE
    }))
}

impl Sandbox {
    /// Returns a sandbox that only sets limits, for your own work. It needs no launcher.
    pub fn none() -> Self {
        Sandbox::at(Isolation::None)
    }

    /// Returns a sandbox at this isolation level. On a machine that doesn't support the level,
    /// nothing can be started.
    pub fn at(level: Isolation) -> Self {
        Sandbox {
            level,
            // This path refers to the running executable, even if its file has been replaced since.
            launcher: PathBuf::from("/proc/self/exe"),
        }
    }

    /// Uses another executable as the launcher. Tests need this, because their own `main` doesn't
    /// call [`run_as_launcher`] first. The `main` of `launcher` must call it.
    pub fn with_launcher(self, launcher: PathBuf) -> Self {
        Sandbox { launcher, ..self }
    }

    /// Returns the level of isolation.
    pub fn level(&self) -> Isolation {
        self.level
    }

    /// Returns whether programs are isolated from the machine at any level above `none`.
    pub fn confines(&self) -> bool {
        self.level > Isolation::None
    }

    /// Starts a program in `folder`. Its environment contains only the variables set by `command`.
    ///
    /// Call this from a thread that lives as long as the program. On Linux, a confined program is
    /// killed when the *thread* that started it ends.
    pub fn start(
        &self,
        mut command: Command,
        folder: &Path,
        profile: Profile,
        limits: Limits,
    ) -> io::Result<Process> {
        if !self.confines() {
            return Process::start(&mut command, folder, limits);
        }
        let request = LaunchRequest {
            level: self.level,
            grader: std::process::id(),
            profile,
            limits,
        };
        let mut launch = Command::new(&self.launcher);
        launch
            .arg(LAUNCH_FLAG)
            .arg(serde_json::to_string(&request)?)
            .arg(command.get_program())
            .args(command.get_args())
            .env_clear();
        let variables = command.get_envs();
        launch.envs(variables.filter_map(|(name, value)| Some((name, value?))));
        Process::launch(&mut launch, folder)
    }
}
