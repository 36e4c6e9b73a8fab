//! A program that was started, and its end.

use std::io::{self, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::sandbox::launch_request::READY;
use crate::system::{self, ExitReason, Limits};

/// The most that is read of a launcher's words.
const MAX_REASON_BYTES: u64 = 4 << 10;

/// A running program, with pipes to its three standard streams. Killed when dropped.
#[derive(Debug)]
pub struct Process {
    /// The process itself, or the launcher that stays beside it.
    pub child: Child,
}

impl Process {
    /// Starts `program` in `folder`, in a process group of its own.
    pub(super) fn start(command: &mut Command, folder: &Path, limits: Limits) -> io::Result<Self> {
        system::use_own_process_group(command);
        let process = Process::spawn(command, folder)?;
        system::set_limits(&process.child, limits)?;
        Ok(process)
    }

    /// Starts a launcher, which makes a session and limits of its own, and waits until it is done.
    /// Its words, if it is not, are the error: that is never the fault of what it would have started.
    pub(super) fn launch(command: &mut Command, folder: &Path) -> io::Result<Self> {
        let mut process = Process::spawn(command, folder)?;
        let mut first = [0];
        let stdout = process.child.stdout.as_mut().expect("it is piped");
        match stdout.read_exact(&mut first) {
            Ok(()) if first == [READY] => Ok(process),
            Ok(()) | Err(_) => {
                let mut reason = String::new();
                let stderr = process.child.stderr.take().expect("it is piped");
                stderr.take(MAX_REASON_BYTES).read_to_string(&mut reason)?;
                Err(io::Error::other(match reason.as_str() {
                    "" => "the launcher ended without a word",
                    words => words,
                }))
            }
        }
    }

    fn spawn(command: &mut Command, folder: &Path) -> io::Result<Self> {
        let child = command
            .current_dir(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        Ok(Process { child })
    }

    /// The CPU time used so far, if the system tells it.
    pub fn cpu_time(&self) -> Option<Duration> {
        system::cpu_time(&self.child)
    }

    /// The memory that it holds now, in bytes, if the system tells it.
    pub fn memory(&self) -> Option<u64> {
        system::memory(&self.child)
    }

    /// How the process ended, if it has.
    pub fn exit_reason(&mut self) -> Option<ExitReason> {
        self.child
            .try_wait()
            .ok()
            .flatten()
            .map(system::exit_reason)
    }

    /// Ends the process and all of its group.
    pub fn kill(&mut self) -> Option<ExitReason> {
        if let Some(ending) = self.exit_reason() {
            return Some(ending);
        }
        system::kill_group(&self.child);
        // A killed process is gone in no time: SIGKILL can not be refused.
        self.child.kill().ok();
        self.child.wait().ok().map(system::exit_reason)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

impl ExitReason {
    /// Whether the process says that all went well. Worth nothing from one that we do not trust.
    pub fn is_success(self) -> bool {
        self == ExitReason::Code(0)
    }

    /// Whether somebody has ended it who is neither itself nor one of its limits: those end a process
    /// by other signals. Where memory runs out, that is the system.
    pub fn is_external_kill(self) -> bool {
        /// SIGKILL, everywhere.
        const KILL: i32 = 9;
        self == ExitReason::Signal(KILL)
    }
}
