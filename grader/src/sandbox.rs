//! Starting a program that we do not trust, with limits, and ending it whatever it does.
//!
//! What it offers today is isolation level `none`: a process group of its own, an empty environment,
//! and limits on memory and CPU, as far as the [`system`] has them.

use std::io;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::system;

pub use crate::system::{Ending, Limits};

/// A running program, with pipes to its three standard streams. Killed when dropped.
#[derive(Debug)]
pub struct Process {
    /// The process itself.
    pub child: Child,
}

impl Process {
    /// Starts `program` in `folder`, in a process group of its own.
    pub fn start(command: &mut Command, folder: &Path, limits: Limits) -> io::Result<Self> {
        command
            .current_dir(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        system::own_group(command);
        let process = Process {
            child: command.spawn()?,
        };
        system::limit(&process.child, limits)?;
        Ok(process)
    }

    /// The CPU time used so far, if the system tells it.
    pub fn cpu_time(&self) -> Option<Duration> {
        system::cpu_time(&self.child)
    }

    /// How the process ended, if it has.
    pub fn ending(&mut self) -> Option<Ending> {
        self.child.try_wait().ok().flatten().map(system::ending)
    }

    /// Ends the process and all of its group.
    pub fn kill(&mut self) -> Option<Ending> {
        if let Some(ending) = self.ending() {
            return Some(ending);
        }
        system::kill_group(&self.child);
        // A killed process is gone in no time: SIGKILL can not be refused.
        self.child.kill().ok();
        self.child.wait().ok().map(system::ending)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

impl Ending {
    /// Whether the process says that all went well. Worth nothing from one that we do not trust.
    pub fn is_success(self) -> bool {
        self == Ending::Code(0)
    }
}
