//! The last step: the program itself.

use std::fs::File;
use std::io;
use std::mem;
use std::os::fd::AsRawFd;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::thread::sleep;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, poll};
use rustix::process::{
    Pid, PidfdFlags, Signal, getppid, kill_current_process_group, pidfd_open,
    set_parent_process_death_signal,
};

use super::super::launch_request::{LaunchRequest, Profile};
use super::{signal_ready, while_doing};

/// How often a program is tried that somebody still holds open for writing, a millisecond apart.
const MAX_EXEC_RETRIES: u32 = 1_000;

/// The program, with its arguments.
pub(super) struct Program {
    command: Command,
    path: PathBuf,
    /// Holds it open, where its path leads through folders that will be closed.
    _file: Option<File>,
}

impl Program {
    /// Opens a probe while it can still be found: it may lie in a folder of root's.
    pub(super) fn open(command: Command, order: &LaunchRequest) -> io::Result<Self> {
        let path = PathBuf::from(command.get_program());
        match order.profile {
            Profile::Compiler { .. } => Ok(Program {
                command,
                path,
                _file: None,
            }),
            Profile::Probe => {
                let file = File::open(&path).map_err(while_doing("open the program"))?;
                let path = PathBuf::from(format!("/proc/self/fd/{}", file.as_raw_fd()));
                let program = Program::with_path(command, path);
                Ok(Program {
                    _file: Some(file),
                    ..program
                })
            }
        }
    }

    /// The same program, found elsewhere.
    pub(super) fn with_path(command: Command, path: PathBuf) -> Self {
        let mut moved = Command::new(&path);
        moved.args(command.get_args());
        Program {
            command: moved,
            path,
            _file: None,
        }
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Its command.
    pub(super) fn into_command(self) -> Command {
        self.command
    }

    /// Turns into it, and so keeps the process number: what the grader measures and ends is the
    /// program itself. When the grader ends, however it ends, the system ends the program.
    pub(super) fn exec(mut self) -> io::Result<ExitCode> {
        signal_ready()?;
        let mut error = self.command.exec();
        for _ in 0..MAX_EXEC_RETRIES {
            // Another thread of the grader has just forked while the program was being written.
            if error.kind() != io::ErrorKind::ExecutableFileBusy {
                break;
            }
            sleep(Duration::from_millis(1));
            error = self.command.exec();
        }
        Err(error)
    }

    /// Starts it, and stays beside it: it starts others, which must all end with it. `cpu` is its
    /// limit.
    pub(super) fn supervise(mut self, cpu: Duration) -> io::Result<ExitCode> {
        signal_ready()?;
        let mut child = self.command.stdin(Stdio::null()).spawn()?;
        let pid = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
        let pid = pid.ok_or_else(|| io::Error::other("the compiler has no number"))?;
        let ended = pidfd_open(pid, PidfdFlags::empty())?;
        // Nobody ever writes to our standard input: its end is the grader's end, however that came.
        let grader = io::stdin();
        let mut events = [
            PollFd::new(&ended, PollFlags::IN),
            PollFd::new(&grader, PollFlags::empty()),
        ];
        poll(&mut events, None)?;
        if events[0].revents().is_empty() {
            kill_current_process_group(Signal::KILL)?;
        }
        let status = child.wait()?;
        if let Some(signal) = status.signal().and_then(Signal::from_named_raw) {
            // The first process of a namespace is spared the signal of the CPU time's soft limit, and
            // ended at the hard one by a signal that says that memory ran out. It did not.
            let signal = match signal == Signal::KILL && children_cpu_time()? >= cpu {
                true => Signal::XCPU,
                false => signal,
            };
            // Ends in the same way, and takes along whatever its program has left behind.
            kill_current_process_group(signal)?;
        }
        let code = u8::try_from(status.code().unwrap_or(1)).unwrap_or(1);
        Ok(ExitCode::from(code))
    }
}

/// The CPU time of all that this process has started and has seen end.
#[allow(unsafe_code, reason = "there is no safe word for this call")]
fn children_cpu_time() -> io::Result<Duration> {
    // SAFETY: a value of plain numbers, which may all be zero.
    let mut usage: libc::rusage = unsafe { mem::zeroed() };
    // SAFETY: it writes one such value, into ours.
    if unsafe { libc::getrusage(libc::RUSAGE_CHILDREN, &raw mut usage) } != 0 {
        return Err(io::Error::last_os_error());
    }
    let time = |value: libc::timeval| {
        let [seconds, micros] =
            [value.tv_sec, value.tv_usec].map(|part| u64::try_from(part).unwrap_or(0));
        Duration::from_secs(seconds) + Duration::from_micros(micros)
    };
    Ok(time(usage.ru_utime) + time(usage.ru_stime))
}

/// Asks the system to end this process when the grader ends, and makes sure that it has not yet.
pub(super) fn die_with_grader(grader: u32) -> io::Result<()> {
    set_parent_process_death_signal(Some(Signal::KILL))
        .map_err(while_doing("be ended with the grader"))?;
    let parent = getppid().map_or(0, |pid| pid.as_raw_nonzero().get());
    match u32::try_from(parent) {
        Ok(parent) if parent == grader => Ok(()),
        Ok(_) | Err(_) => Err(io::Error::other("the grader has ended")),
    }
}
