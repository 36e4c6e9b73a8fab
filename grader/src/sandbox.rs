//! Starting a program that we do not trust, with limits, and ending it whatever it does.
//!
//! This is the one place that knows the operating system. What it offers today is isolation level
//! `none`: a process group of its own, an empty environment, and limits on memory and CPU.

use std::io;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

/// What a process may use. Where the system knows no such limit, wall time is the only one.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Address space, in bytes.
    pub memory: u64,
    /// CPU time of the process over its whole life.
    pub cpu: Duration,
    /// The largest file that it may write, in bytes.
    pub file: u64,
}

/// A running program, with pipes to its three standard streams. Killed when dropped.
#[derive(Debug)]
pub struct Process {
    /// The process itself.
    pub child: Child,
}

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// By itself, with this exit code.
    Code(i32),
    /// By this signal.
    Signal(i32),
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
        self.child.try_wait().ok().flatten().map(ending)
    }

    /// Ends the process and all of its group.
    pub fn kill(&mut self) -> Option<Ending> {
        if let Some(ending) = self.ending() {
            return Some(ending);
        }
        system::kill_group(&self.child);
        // A killed process is gone in no time: SIGKILL can not be refused.
        self.child.kill().ok();
        self.child.wait().ok().map(ending)
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

#[cfg(unix)]
fn ending(status: ExitStatus) -> Ending {
    use std::os::unix::process::ExitStatusExt;

    match status.code() {
        Some(code) => Ending::Code(code),
        None => Ending::Signal(status.signal().unwrap_or(0)),
    }
}

#[cfg(not(unix))]
fn ending(status: ExitStatus) -> Ending {
    Ending::Code(status.code().unwrap_or(-1))
}

#[cfg(target_os = "linux")]
mod system {
    use std::fs;
    use std::io;
    use std::os::unix::process::CommandExt;
    use std::process::{Child, Command};
    use std::time::Duration;

    use rustix::process::{Pid, Resource, Rlimit, Signal, kill_process_group, prlimit};

    use super::Limits;

    pub(super) fn own_group(command: &mut Command) {
        command.process_group(0);
    }

    pub(super) fn limit(child: &Child, limits: Limits) -> io::Result<()> {
        // The child has run for a moment without limits. It is still starting: a probe does
        // nothing before its first question, which is sent after this.
        for (resource, most) in [
            (Resource::As, limits.memory),
            (Resource::Cpu, limits.cpu.as_secs().max(1)),
            (Resource::Fsize, limits.file),
            (Resource::Core, 0),
        ] {
            let limit = Rlimit {
                current: Some(most),
                maximum: Some(most),
            };
            match prlimit(pid(child), resource, limit) {
                // It has ended already, which whoever waits for it will see.
                Ok(_) | Err(rustix::io::Errno::SRCH) => {}
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    pub(super) fn cpu_time(child: &Child) -> Option<Duration> {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
        // The second field, a name in parentheses, may hold spaces: count after its end. utime
        // and stime are fields 14 and 15 (proc_pid_stat(5)).
        let (_, fields) = stat.rsplit_once(')')?;
        let mut fields = fields.split_whitespace().skip(11);
        let ticks = fields.next()?.parse::<u64>().ok()? + fields.next()?.parse::<u64>().ok()?;
        let hertz = rustix::param::clock_ticks_per_second();
        Some(Duration::from_secs_f64(ticks as f64 / hertz as f64))
    }

    pub(super) fn kill_group(child: &Child) {
        if let Some(pid) = pid(child) {
            kill_process_group(pid, Signal::KILL).ok();
        }
    }

    fn pid(child: &Child) -> Option<Pid> {
        Pid::from_raw(i32::try_from(child.id()).ok()?)
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    use std::io;
    use std::process::{Child, Command};
    use std::time::Duration;

    use super::Limits;

    pub(super) fn own_group(_: &mut Command) {}

    pub(super) fn limit(_: &Child, _: Limits) -> io::Result<()> {
        Ok(())
    }

    pub(super) fn cpu_time(_: &Child) -> Option<Duration> {
        None
    }

    pub(super) fn kill_group(_: &Child) {}
}
