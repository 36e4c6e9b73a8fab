//! A started program and how it ends.

use std::io::{self, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::machine::system::{self, ExitReason, Limits, ProcessTime};
use crate::sandbox::launch_request::READY;

/// The maximum number of bytes of a launcher's error message to read.
const MAX_REASON_BYTES: u64 = 4 << 10;

/// A running program, with pipes to its three standard streams. The program is killed when this
/// value is dropped.
#[derive(Debug)]
pub struct Process {
    /// The program's process, or the launcher that supervises it.
    pub child: Child,
}

impl Process {
    /// Starts a program in `folder`, in its own process group.
    pub(super) fn start(command: &mut Command, folder: &Path, limits: Limits) -> io::Result<Self> {
        system::use_own_process_group(command);
        let process = Process::spawn(command, folder)?;
        system::set_limits(&process.child, limits)?;
        Ok(process)
    }

    /// Starts a launcher, which sets up its own session and limits. Waits until the sandbox is in
    /// place. If the launcher fails, its message becomes the error. Such a failure is never the
    /// fault of the program to be started.
    pub(super) fn launch(command: &mut Command, folder: &Path) -> io::Result<Self> {
        let mut process = Process::spawn(command, folder)?;
        let mut first = [0];
        let stdout = process
            .child
            .stdout
            .as_mut()
            .expect("standard output is piped");
        match stdout.read_exact(&mut first) {
            Ok(()) if first == [READY] => Ok(process),
            Ok(()) | Err(_) => {
                let mut reason = String::new();
                let stderr = process
                    .child
                    .stderr
                    .take()
                    .expect("standard error is piped");
                stderr.take(MAX_REASON_BYTES).read_to_string(&mut reason)?;
                Err(io::Error::other(match reason.as_str() {
                    "" => "the launcher ended without an error message",
                    message => message,
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

    /// Returns the CPU time used so far, if the system reports it.
    pub fn cpu_time(&self) -> Option<Duration> {
        system::cpu_time(&self.child)
    }

    /// Returns the CPU time used so far by the process and by those of its children that it has
    /// waited for, if the system reports it. After the process has ended, the time is available
    /// until [`Process::exit_reason`] returns the reason.
    pub fn cpu_time_with_children(&self) -> Option<Duration> {
        system::cpu_time_with_children(&self.child)
    }

    /// Returns how the process has used its time so far, if the system reports it.
    pub fn time(&self) -> Option<ProcessTime> {
        system::process_time(&self.child)
    }

    /// Returns the resident memory in bytes, if the system reports it.
    pub fn memory(&self) -> Option<u64> {
        system::memory(&self.child)
    }

    /// Returns the reason the process ended, or `None` if it is still running.
    pub fn exit_reason(&mut self) -> Option<ExitReason> {
        self.child
            .try_wait()
            .ok()
            .flatten()
            .map(system::exit_reason)
    }

    /// Kills the process and its process group. Returns the reason the process ended.
    pub fn kill(&mut self) -> Option<ExitReason> {
        if let Some(reason) = self.exit_reason() {
            return Some(reason);
        }
        system::kill_group(&self.child);
        // This wait is short, because a process cannot ignore SIGKILL.
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
    /// Returns whether the process exited with code 0. This proves nothing if the program is
    /// untrusted.
    pub fn is_success(self) -> bool {
        self == ExitReason::Code(0)
    }

    /// Returns whether the process was killed with SIGKILL, the signal that the system sends when
    /// memory runs out. The cause is outside the process, because its own limits use other signals
    /// and a confined probe cannot send this signal to itself.
    pub fn is_external_kill(self) -> bool {
        /// The number of the signal SIGKILL, which is the same on every system.
        const KILL: i32 = 9;
        self == ExitReason::Signal(KILL)
    }

    /// Returns whether the process was ended by its CPU time limit.
    pub fn is_time_limit(self) -> bool {
        /// The number of SIGXCPU on Linux, where this limit is set.
        const XCPU: i32 = 24;
        cfg!(target_os = "linux") && self == ExitReason::Signal(XCPU)
    }
}
