//! A running program of the submission, and the exchange of requests and responses with it.
//! Nothing that it does can block the viewer.

use std::io::{BufReader, Read, Write};
use std::path::Path;
use std::process::Command;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use grader::capture::Capture;
use grader::probe::{Crash, Fault, TimeLimit};
use grader::sandbox::{ExitReason, Process, Profile};
use grader::system::{self, Limits};
use protocol::wire::{self, Frame, WireError};
use view_probe::messages::{Request, Response};

use crate::program::Program;

/// The maximum CPU time of a program. It only ends one that has been forgotten: each request has a
/// limit of its own.
const CPU_LIMIT: Duration = Duration::from_secs(24 * 3600);
/// The maximum size of the output that is kept, in bytes.
const MAX_OUTPUT_BYTES: usize = 16 << 10;
/// The polling interval for a program that is computing.
const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// The wall time that each request has in addition to a multiple of its CPU time.
const WALL_RESERVE: Duration = Duration::from_secs(5);
/// The time in which a program that has closed its pipe must end.
const EXIT_TIMEOUT: Duration = Duration::from_secs(2);

/// A running program.
#[derive(Debug)]
pub struct Probe {
    process: Process,
    requests: Sender<Vec<u8>>,
    /// The maximum size of each response. Nothing is read that was not asked for.
    limits: Sender<usize>,
    responses: Receiver<Result<Frame, WireError>>,
    output: Capture,
    nonce: u64,
    // Its file must exist while it runs.
    _program: Program,
}

/// A reason why a request got no response. The program has ended.
#[derive(Debug)]
pub enum NoResponse {
    /// The submission's code failed.
    Fault(Fault),
    /// The response is no longer wanted.
    Abandoned,
}

impl Probe {
    /// Starts a program with this limit of memory, in bytes. On Linux it ends with the thread that
    /// started it.
    pub fn start(program: &Program, memory: u64) -> std::io::Result<Self> {
        let (path, sandbox) = program.executable();
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut command = Command::new(&path);
        system::clear_environment(&mut command);
        let limits = Limits {
            data: None,
            memory,
            cpu: CPU_LIMIT,
            file: 0,
        };
        let mut process = sandbox.start(command, folder, Profile::Probe, limits)?;
        let stdin = process.child.stdin.take().expect("the stream is piped");
        let stdout = process.child.stdout.take().expect("the stream is piped");
        let stderr = process.child.stderr.take().expect("the stream is piped");
        let (requests, to_write) = channel();
        let (limits, to_read) = channel();
        let (answered, responses) = channel();
        thread::spawn(move || write(stdin, to_write));
        thread::spawn(move || read(stdout, to_read, answered));
        Ok(Probe {
            process,
            requests,
            limits,
            responses,
            output: Capture::start(stderr, MAX_OUTPUT_BYTES),
            nonce: 0,
            _program: program.clone(),
        })
    }

    /// Sends a request and waits for the response, for at most `limit` of CPU time. Ends the
    /// program if it fails, or as soon as `is_abandoned`.
    pub fn ask(
        &mut self,
        request: &Request,
        limit: Duration,
        is_abandoned: impl Fn() -> bool,
    ) -> Result<Response, NoResponse> {
        self.nonce += 1;
        let frame = wire::encode(self.nonce, request)
            .map_err(|error| NoResponse::Fault(Fault::Protocol(error.to_string())))?;
        // If a thread has ended, the missing response is noticed below.
        self.limits.send(request.max_response_bytes()).ok();
        self.requests.send(frame).ok();
        let started_at = Instant::now();
        let cpu_before = self.process.cpu_time();
        // The first part of the time is spent waiting for the pipe alone, which costs nothing.
        let frame = loop {
            match self.responses.recv_timeout(POLL_INTERVAL) {
                Ok(Ok(frame)) => break frame,
                Ok(Err(WireError::EndOfStream | WireError::Io(_)))
                | Err(RecvTimeoutError::Disconnected) => {
                    return Err(NoResponse::Fault(self.post_mortem()));
                }
                Ok(Err(error)) => {
                    self.process.kill();
                    return Err(NoResponse::Fault(Fault::Protocol(error.to_string())));
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            if is_abandoned() {
                self.process.kill();
                return Err(NoResponse::Abandoned);
            }
            let cpu = self.process.cpu_time().zip(cpu_before);
            let cpu = cpu.map(|(now, before)| now.saturating_sub(before));
            // Generous: on a busy machine, wall time says nothing about the code.
            let wall = 4 * limit + WALL_RESERVE;
            if cpu.is_some_and(|cpu| cpu >= limit) {
                self.process.kill();
                return Err(NoResponse::Fault(Fault::TimedOut(TimeLimit::Cpu)));
            }
            if started_at.elapsed() >= wall {
                self.process.kill();
                return Err(NoResponse::Fault(Fault::TimedOut(TimeLimit::Wall)));
            }
        };
        let response = frame.decode().map_err(|error| error.to_string());
        let response = response.and_then(|response: Response| {
            if frame.nonce == self.nonce && response.answers(request) {
                Ok(response)
            } else {
                Err("a response that does not belong to the request".to_owned())
            }
        });
        response.map_err(|why| {
            self.process.kill();
            NoResponse::Fault(Fault::Protocol(why))
        })
    }

    /// Determines why the program ended.
    fn post_mortem(&mut self) -> Fault {
        let deadline = Instant::now() + EXIT_TIMEOUT;
        while self.process.exit_reason().is_none() && Instant::now() < deadline {
            thread::sleep(Duration::from_millis(1));
        }
        let reason = self.process.kill();
        self.output.wait_for_end(Duration::from_millis(200));
        let output = self.output.head();
        match reason {
            Some(ExitReason::Code(code)) => Fault::Crashed(Crash::Exited(code)),
            Some(ExitReason::Signal(_)) if output.contains("has overflowed its stack") => {
                Fault::Crashed(Crash::StackOverflow)
            }
            Some(ExitReason::Signal(_)) if output.contains("memory allocation of ") => {
                Fault::OutOfMemory
            }
            Some(ExitReason::Signal(signal)) => Fault::Crashed(Crash::Signal(signal)),
            None => Fault::Crashed(Crash::Signal(0)),
        }
    }
}

fn write(mut stdin: impl Write, frames: Receiver<Vec<u8>>) {
    for frame in frames {
        if stdin
            .write_all(&frame)
            .and_then(|()| stdin.flush())
            .is_err()
        {
            return; // The reading thread notices that the pipe is closed.
        }
    }
}

fn read(stdout: impl Read, limits: Receiver<usize>, answered: Sender<Result<Frame, WireError>>) {
    let mut stdout = BufReader::with_capacity(1 << 16, stdout);
    for limit in limits {
        let frame = wire::read(&mut stdout, limit);
        let is_over = frame.is_err();
        if answered.send(frame).is_err() || is_over {
            return;
        }
    }
}
