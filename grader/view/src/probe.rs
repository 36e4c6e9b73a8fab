//! A running program with the submission's code, and the requests and responses exchanged with it.

use std::time::Duration;

use grader::probe::{Batch, Crash, Fault, ItemLimits, RunningProgram, Stopwatch};
use grader::system::Limits;
use protocol::wire;
use view_probe::messages::{Request, Response, SubmissionPart};

use crate::program::Program;

/// The maximum CPU time of a program. This limit only ends forgotten programs, because each request
/// has its own limit.
const CPU_LIMIT: Duration = Duration::from_secs(24 * 3600);
/// The minimum CPU time limit for a request during which the program prints a lot.
const LIMIT_IF_PRINTING: Duration = Duration::from_secs(10);
/// How long a program may wait for something other than a processor.
const WAITING_LIMIT: Duration = Duration::from_secs(2);

/// A running program.
#[derive(Debug)]
pub struct Probe {
    running: RunningProgram,
    nonce: u64,
    // The program's file must exist while the program runs.
    _program: Program,
}

/// The reason a job produced no result.
#[derive(Debug, thiserror::Error)]
pub enum Stop {
    /// The result is no longer wanted, or the reason has already been reported.
    #[error("the result is no longer needed")]
    Unwanted,
    /// The program failed, in this method if it is known.
    #[error("{1}")]
    Fault(Option<SubmissionPart>, Fault),
    /// The program could not be started, or its response is unusable.
    #[error("{0}")]
    Invalid(String),
}

impl Probe {
    /// Starts a program with this memory limit, in bytes.
    pub fn start(program: &Program, memory: u64) -> std::io::Result<Self> {
        let launcher = program.launcher();
        let limits = Limits {
            data: None,
            memory,
            cpu: CPU_LIMIT,
            file: 0,
        };
        Ok(Probe {
            running: RunningProgram::start(&launcher.program, &launcher.sandbox, limits)?,
            nonce: 0,
            _program: program.clone(),
        })
    }

    /// Sends a request and waits for the response. Gives up when the program has used `limit` of
    /// CPU time or when `is_abandoned` returns true. After an error, the program must not be used
    /// again.
    pub fn ask(
        &mut self,
        request: &Request,
        limit: Duration,
        mut is_abandoned: impl FnMut() -> bool,
    ) -> Result<Response, Stop> {
        self.nonce += 1;
        let mut batch = Batch::default();
        let append = |frames| wire::append(frames, self.nonce, request);
        batch.add(request.max_response_bytes(), append)?;
        self.running.send(batch);
        let mut stopwatch = Stopwatch::start(ItemLimits {
            cpu: limit,
            cpu_if_printing: limit.max(LIMIT_IF_PRINTING),
            waiting: WAITING_LIMIT,
        });
        let printed_before = self.running.printed();
        let frame = loop {
            // Wait for the pipe for a short time before checking the limits, since waiting costs
            // nothing.
            if let Some(frame) = self.running.next_frame()? {
                break frame;
            }
            if is_abandoned() {
                return Err(Stop::Unwanted);
            }
            let printed = self.running.printed() - printed_before;
            if let Some(over) = stopwatch.exceeded(self.running.process.time(), printed) {
                return Err(Fault::TimedOut(over).into());
            }
        };
        let response: Response = frame
            .decode()
            .map_err(|error| Fault::Protocol(error.to_string()))?;
        if frame.nonce != self.nonce || !response.answers(request) {
            let why = "a response that does not match the request";
            return Err(Fault::Protocol(why.to_owned()).into());
        }
        Ok(response)
    }
}

impl Stop {
    /// If the program failed, also records which method was being called.
    pub fn in_part(self, part: SubmissionPart) -> Self {
        match self {
            Stop::Fault(_, fault) => Stop::Fault(Some(part), fault),
            Stop::Unwanted | Stop::Invalid(_) => self,
        }
    }
}

impl From<Fault> for Stop {
    fn from(fault: Fault) -> Self {
        // Unlike the grader, the viewer doesn't rerun a program to find out why it was killed.
        let is_killed = fault == Fault::Crashed(Crash::Killed);
        let shown = Fault::Crashed(Crash::Signal(9));
        Stop::Fault(None, if is_killed { shown } else { fault })
    }
}
