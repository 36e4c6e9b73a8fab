//! Starting a program that we do not trust, with limits, and ending it whatever it does.
//!
//! One's own work runs at level `none`: a process group of its own, an empty environment, limits on
//! memory and CPU as far as the [`system`](crate::system) has them. Others' runs behind a *launcher*,
//! which is this very program started once more: it gives up, one after the other, all that the
//! program after it shall not have, and then becomes that program. All of that is Linux; unsupported
//! there is no level but `none`.
//!
//! What each level promises, and what none does, stands in `grader/SECURITY.md`.

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

use crate::system::Limits;

use launch_request::{LAUNCH_FLAG, LaunchRequest};
#[cfg(target_os = "linux")]
use linux as platform;
#[cfg(not(target_os = "linux"))]
use unsupported as platform;

pub use crate::system::ExitReason;
pub use isolation::Isolation;
pub use launch_request::Profile;
pub use process::Process;

/// Starts programs at one level of isolation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sandbox {
    level: Isolation,
    launcher: PathBuf,
}

/// The first thing in the `main` of each program that opens a [`Sandbox`]: if it was started as the
/// launcher, it does that work and nothing else. `None` for everyone else.
pub fn run_as_launcher() -> Option<ExitCode> {
    let mut arguments = env::args_os().skip(1);
    if arguments.next()? != LAUNCH_FLAG {
        return None;
    }
    Some(platform::launch(arguments).unwrap_or_else(|error| {
        // Read by the grader: nothing else was started yet.
        eprint!("{error}");
        ExitCode::FAILURE
    }))
}

impl Sandbox {
    /// No more than limits: for one's own work. Costs nothing.
    pub fn none() -> Self {
        Sandbox::at(Isolation::None)
    }

    /// This level and no less: where the machine does not reach it, nothing starts.
    pub fn at(level: Isolation) -> Self {
        Sandbox {
            level,
            // Also if the program's file was replaced meanwhile.
            launcher: PathBuf::from("/proc/self/exe"),
        }
    }

    /// With another program as the launcher, whose `main` begins with [`launched`]: for programs
    /// whose own does not, such as tests.
    pub fn with_launcher(self, launcher: PathBuf) -> Self {
        Sandbox { launcher, ..self }
    }

    /// The level.
    pub fn level(&self) -> Isolation {
        self.level
    }

    /// Whether programs are kept apart from the machine at all.
    pub fn confines(&self) -> bool {
        self.level > Isolation::None
    }

    /// Starts a program in `folder`. Its environment is what `command` sets, and nothing else.
    ///
    /// Whoever starts it must be the thread that stays to its end: on Linux, what is confined ends
    /// with the *thread* that started it.
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
        let order = LaunchRequest {
            level: self.level,
            grader: std::process::id(),
            profile,
            limits,
        };
        let mut launch = Command::new(&self.launcher);
        launch
            .arg(LAUNCH_FLAG)
            .arg(serde_json::to_string(&order)?)
            .arg(command.get_program())
            .args(command.get_args())
            .env_clear();
        let variables = command.get_envs();
        launch.envs(variables.filter_map(|(name, value)| Some((name, value?))));
        Process::launch(&mut launch, folder)
    }
}
