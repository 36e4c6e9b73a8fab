//! The launcher's last step: starting the program.

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

/// The maximum number of times to retry executing a program whose file is still open for writing in
/// another process. The retries are one millisecond apart.
const MAX_EXEC_RETRIES: u32 = 1_000;

/// The program to execute, with its arguments.
pub(super) struct Program {
    command: Command,
    path: PathBuf,
    /// The program's file, kept open if its path leads through folders that will become
    /// inaccessible.
    _file: Option<File>,
}

impl Program {
    /// Opens a probe's file while it is still accessible, since it may be in a folder that only
    /// root can read.
    pub(super) fn open(command: Command, request: &LaunchRequest) -> io::Result<Self> {
        let path = PathBuf::from(command.get_program());
        match request.profile {
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

    /// Creates a program from a command, replacing the path to its executable with `path`.
    pub(super) fn with_path(command: Command, path: PathBuf) -> Self {
        let mut moved = Command::new(&path);
        moved.args(command.get_args());
        Program {
            command: moved,
            path,
            _file: None,
        }
    }

    /// Returns the path of the program.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the command.
    pub(super) fn into_command(self) -> Command {
        self.command
    }

    /// Replaces this process with the program. The process id stays the same, so the grader can
    /// measure and kill the program directly. The system kills the program when the grader ends,
    /// even if the grader is killed.
    pub(super) fn exec(mut self) -> io::Result<ExitCode> {
        signal_ready()?;
        let mut error = self.command.exec();
        for _ in 0..MAX_EXEC_RETRIES {
            // Another thread of the grader forked while the program's file was being written, and
            // its child still has the file open.
            if error.kind() != io::ErrorKind::ExecutableFileBusy {
                break;
            }
            sleep(Duration::from_millis(1));
            error = self.command.exec();
        }
        Err(error)
    }

    /// Starts the program and waits for it. This process stays alive, because the program starts
    /// other processes, which must not outlive the program or the grader. `cpu` is the program's
    /// CPU time limit.
    pub(super) fn supervise(mut self, cpu: Duration) -> io::Result<ExitCode> {
        signal_ready()?;
        let mut child = self.command.stdin(Stdio::null()).spawn()?;
        let pid = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
        let pid = pid.ok_or_else(|| io::Error::other("the compiler has no process id"))?;
        let ended = pidfd_open(pid, PidfdFlags::empty())?;
        // The grader never writes to our standard input, which is only closed when the grader ends.
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
            // The first process of a PID namespace doesn't receive SIGXCPU at the soft limit. The
            // hard limit then kills it with SIGKILL, which would look as if memory had run out.
            let signal = if signal == Signal::KILL && children_cpu_time()? >= cpu {
                Signal::XCPU
            } else {
                signal
            };
            // End this process with the same signal, together with everything the program left
            // running.
            kill_current_process_group(signal)?;
        }
        let code = u8::try_from(status.code().unwrap_or(1)).unwrap_or(1);
        Ok(ExitCode::from(code))
    }
}

/// Returns the CPU time of all children that this process has started and waited for.
#[allow(unsafe_code, reason = "there is no safe wrapper for this call")]
fn children_cpu_time() -> io::Result<Duration> {
    // SAFETY: the struct contains only integers, for which zero is a valid value.
    let mut usage: libc::rusage = unsafe { mem::zeroed() };
    // SAFETY: the call writes one struct of this type, into `usage`.
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

/// Makes the system kill this process when the grader ends. Fails if the grader has already ended.
pub(super) fn die_with_grader(grader: u32) -> io::Result<()> {
    set_parent_process_death_signal(Some(Signal::KILL))
        .map_err(while_doing("tie this process to the grader"))?;
    let parent = getppid().map_or(0, |pid| pid.as_raw_nonzero().get());
    match u32::try_from(parent) {
        Ok(parent) if parent == grader => Ok(()),
        Ok(_) | Err(_) => Err(io::Error::other("the grader has ended")),
    }
}
