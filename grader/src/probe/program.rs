//! A running program that answers requests over its pipes.

use std::io;
use std::path::Path;
use std::process::Command;
use std::sync::mpsc::RecvTimeoutError;
use std::thread;
use std::time::{Duration, Instant};

use protocol::wire::{Frame, WireError};

use super::fault::{Crash, Fault};
use super::streams::{Batch, Streams};
use crate::machine::capture::Capture;
use crate::machine::system::{self, Limits};
use crate::sandbox::{ExitReason, Process, Profile, Sandbox};

/// Maximum size of the stored part of a program's output, in bytes.
const MAX_OUTPUT_BYTES: usize = 64 << 10;
/// Polling interval for a silent program.
const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// Time to wait for the remaining output of a program that has ended.
const OUTPUT_TIMEOUT: Duration = Duration::from_millis(200);
/// Time to wait for a program to end after it closes its pipe. Freeing its memory may take a while
/// on a busy machine.
pub(super) const EXIT_TIMEOUT: Duration = Duration::from_secs(2);

// Parts of messages that the Rust runtime prints when it ends the process.
const STACK_OVERFLOW: &str = "has overflowed its stack";
const OUT_OF_MEMORY: &str = "memory allocation of ";
const RUNTIME_MESSAGES: [&str; 4] = [
    STACK_OVERFLOW,
    OUT_OF_MEMORY,
    "fatal runtime error",
    "note: run with `RUST_BACKTRACE=1`",
];

/// A submission's running program. Nothing it does can block the thread that uses it.
#[derive(Debug)]
pub struct RunningProgram {
    /// The process, used to measure its time and memory and to kill it.
    pub process: Process,
    streams: Streams,
    output: Capture,
}

impl RunningProgram {
    /// Starts a program. On Linux, the program ends when the thread that started it ends, so that
    /// it doesn't outlive a killed grader.
    pub fn start(program: &Path, sandbox: &Sandbox, limits: Limits) -> io::Result<Self> {
        let folder = program.parent().unwrap_or(Path::new("."));
        let mut command = Command::new(program);
        system::clear_environment(&mut command);
        let mut process = sandbox.start(command, folder, Profile::Probe, limits)?;
        let stdin = process.child.stdin.take().expect("the stream is piped");
        let stdout = process.child.stdout.take().expect("the stream is piped");
        let stderr = process.child.stderr.take().expect("the stream is piped");
        Ok(RunningProgram {
            process,
            streams: Streams::open(stdin, stdout),
            output: Capture::start(stderr, MAX_OUTPUT_BYTES),
        })
    }

    /// Sends requests. If the program has ended, the missing response will be noticed later.
    pub fn send(&self, requests: Batch) {
        self.streams.send(requests);
    }

    /// Returns the next response, or `None` if none arrives within a short time, so that the caller
    /// can check its limits.
    pub fn next_frame(&mut self) -> Result<Option<Frame>, Fault> {
        match self.streams.next(POLL_INTERVAL) {
            Ok(Ok(frame)) => Ok(Some(frame)),
            Ok(Err(WireError::EndOfStream | WireError::Io(_)))
            | Err(RecvTimeoutError::Disconnected) => Err(self.post_mortem()),
            Ok(Err(error)) => {
                self.process.kill();
                Err(Fault::Protocol(error.to_string()))
            }
            // A child process of the program may keep the pipe open, so don't wait for it to close.
            Err(RecvTimeoutError::Timeout) if self.process.exit_reason().is_some() => {
                match self.streams.next(OUTPUT_TIMEOUT) {
                    Ok(Ok(frame)) => Ok(Some(frame)),
                    Ok(Err(_)) | Err(_) => Err(self.post_mortem()),
                }
            }
            Err(RecvTimeoutError::Timeout) => Ok(None),
        }
    }

    /// Returns the number of bytes that the program has printed.
    pub fn printed(&self) -> u64 {
        self.output.total()
    }

    /// Kills the program. Returns the beginning of its output, without the messages of the Rust
    /// runtime.
    pub fn finish(mut self) -> String {
        self.process.kill();
        let output = self.output_at_end();
        let is_own = |line: &&str| !RUNTIME_MESSAGES.iter().any(|text| line.contains(text));
        output.lines().filter(is_own).collect::<Vec<_>>().join("\n")
    }

    /// Determines the reason the program ended. The program's output is only used for diagnosis
    /// and cannot earn points.
    fn post_mortem(&mut self) -> Fault {
        // The program may have closed its pipe without ending.
        let deadline = Instant::now() + EXIT_TIMEOUT;
        while self.process.exit_reason().is_none() && Instant::now() < deadline {
            thread::sleep(Duration::from_millis(1));
        }
        let ended = self.process.exit_reason();
        if ended.is_some_and(ExitReason::is_external_kill) {
            return Fault::Crashed(Crash::Killed);
        }
        let reason = self.process.kill();
        let output = self.output_at_end();
        match reason {
            Some(ExitReason::Code(code)) => Fault::Crashed(Crash::Exited(code)),
            Some(ExitReason::Signal(_)) if output.contains(STACK_OVERFLOW) => {
                Fault::Crashed(Crash::StackOverflow)
            }
            Some(ExitReason::Signal(_)) if output.contains(OUT_OF_MEMORY) => Fault::OutOfMemory,
            Some(ExitReason::Signal(signal)) => Fault::Crashed(Crash::Signal(signal)),
            None => Fault::Crashed(Crash::Signal(0)),
        }
    }

    fn output_at_end(&mut self) -> String {
        self.output.wait_for_end(OUTPUT_TIMEOUT);
        self.output.head()
    }
}
