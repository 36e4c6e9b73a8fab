//! Asking a probe: questions go in, answers come out, and nothing that happens there can hold the
//! grader up.

mod budget;
mod culprit;
mod fault;
mod streams;
mod subset;

use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc::RecvTimeoutError;
use std::thread;
use std::time::{Duration, Instant};

use protocol::wire::{Frame, WireError};
use protocol::{Answer, Question};

use crate::capture::Capture;
use crate::sandbox::{ExitReason, Process, Profile, Sandbox};
use crate::system::{self, Limits};

use budget::BudgetTracker;
use streams::{Batch, Streams};

pub use budget::Budget;
pub use culprit::culprit;
pub use fault::{Crash, Fault, TimeLimit};
pub use subset::subset;

/// How much is kept of what a submission prints.
const MAX_OUTPUT_BYTES: usize = 64 << 10;
/// How often a probe that is silent is looked at.
const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// How long the last words of a probe that has ended may take to arrive.
const OUTPUT_TIMEOUT: Duration = Duration::from_millis(200);

/// How long a probe may take to be gone after it has closed its pipe: all of its memory is to be
/// given back, on a machine that may be busy.
const EXIT_TIMEOUT: Duration = Duration::from_secs(2);

// What Rust's runtime says on its way out.
const STACK_OVERFLOW: &str = "has overflowed its stack";
const OUT_OF_MEMORY: &str = "memory allocation of ";
const RUNTIME_MESSAGES: [&str; 4] = [
    STACK_OVERFLOW,
    OUT_OF_MEMORY,
    "fatal runtime error",
    "note: run with `RUST_BACKTRACE=1`",
];

/// A running probe.
#[derive(Debug)]
pub struct Probe {
    process: Process,
    streams: Streams,
    output: Capture,
    /// The most memory that it was seen to hold, in bytes.
    memory: u64,
}

/// Starts probes of one submission.
#[derive(Clone, Debug)]
pub struct Launcher {
    /// The program.
    pub program: PathBuf,
    /// How it is kept apart.
    pub sandbox: Sandbox,
}

impl Launcher {
    /// Address space of a probe, of which 64 MiB are stack.
    const MEMORY_LIMIT: u64 = 1 << 30;
    /// A probe serves a whole task, whose items are judged by their own time. This many items' time
    /// ends it even if the grader itself is killed.
    const MAX_ITEMS_PER_TASK: u32 = 30;
    /// Who holds more of it than this and is killed, has itself to blame: honest ones hold a tenth.
    const LARGE_MEMORY: u64 = Self::MEMORY_LIMIT / 4;

    /// Starts a process that waits for its first question. On Linux it ends with the thread that
    /// starts it, so that it does not outlive a grader that is killed.
    ///
    /// Before that question none of the submission's code runs: what fails until then is our fault, or
    /// the machine's.
    pub fn start(&self, budget: Budget) -> io::Result<Probe> {
        let folder = self.program.parent().unwrap_or(Path::new("."));
        let mut command = Command::new(&self.program);
        system::clear_environment(&mut command);
        let limits = Limits {
            memory: Self::MEMORY_LIMIT,
            cpu: Self::MAX_ITEMS_PER_TASK * budget.cpu,
            file: 0,
        };
        let mut process = self
            .sandbox
            .start(command, folder, Profile::Probe, limits)?;
        let stdin = process.child.stdin.take().expect("it is piped");
        let stdout = process.child.stdout.take().expect("it is piped");
        let stderr = process.child.stderr.take().expect("it is piped");
        let mut probe = Probe {
            process,
            streams: Streams::open(stdin, stdout),
            output: Capture::start(stderr, MAX_OUTPUT_BYTES),
            memory: 0,
        };
        match probe.ask([], budget) {
            Ok(_) => Ok(probe),
            Err(fault) => {
                let said = probe.finish();
                Err(io::Error::other(format!(
                    "{fault}, and nothing was asked yet: see `cargo grade --doctor` {said}"
                )))
            }
        }
    }
}

impl Probe {
    /// Asks all questions at once and takes the answers as they come. After a fault the probe is
    /// of no more use.
    pub fn ask<'a>(
        &mut self,
        questions: impl IntoIterator<Item = &'a Question>,
        budget: Budget,
    ) -> Result<Vec<Answer>, Fault> {
        // The last one asks nothing: bytes that came before its answer were not asked for.
        let questions: Vec<&Question> = questions.into_iter().chain([&Question::Done]).collect();
        let nonces = nonces(questions.len());
        let mut batch = Batch::default();
        for (nonce, question) in nonces.iter().zip(questions) {
            batch
                .add(*nonce, question)
                .map_err(|error| Fault::Protocol(format!("can not be asked: {error}")))?;
            if batch.is_full() {
                self.streams.send(mem::take(&mut batch));
            }
        }
        self.streams.send(batch);

        let mut watch = BudgetTracker::start(budget);
        let mut answers = Vec::with_capacity(nonces.len());
        for nonce in nonces {
            let frame = self.next_frame(&mut watch)?;
            if frame.nonce != nonce {
                return Err(Fault::Protocol("an answer to no question".to_owned()));
            }
            answers.push(frame.answer().map_err(protocol_fault)?);
        }
        match answers.pop() {
            Some(Answer::Done) => Ok(answers),
            _ => Err(Fault::Protocol("an answer of another kind".to_owned())),
        }
    }

    /// Ends the probe. What the submission has printed, the beginning of it, without the
    /// runtime's own last words.
    pub fn finish(mut self) -> String {
        self.process.kill();
        self.output.wait_for_end(OUTPUT_TIMEOUT);
        let words = self.output.head();
        let lines = words
            .lines()
            .filter(|line| !RUNTIME_MESSAGES.iter().any(|words| line.contains(words)));
        lines.collect::<Vec<_>>().join("\n")
    }

    fn next_frame(&mut self, watch: &mut BudgetTracker) -> Result<Frame, Fault> {
        loop {
            match self.streams.next(POLL_INTERVAL) {
                Ok(Ok(frame)) => return Ok(frame),
                Ok(Err(WireError::EndOfStream | WireError::Io(_)))
                | Err(RecvTimeoutError::Disconnected) => return Err(self.post_mortem()),
                Ok(Err(error)) => return Err(protocol_fault(error)),
                Err(RecvTimeoutError::Timeout) => {}
            }
            self.memory = self.memory.max(self.process.memory().unwrap_or(0));
            if let Some(over) = watch.exceeded(self.process.cpu_time()) {
                self.process.kill();
                return Err(Fault::TimedOut(over));
            }
            // A child of the probe may hold the pipe open: do not wait for its end.
            if self.process.exit_reason().is_some() {
                return match self.streams.next(OUTPUT_TIMEOUT) {
                    Ok(Ok(frame)) => Ok(frame),
                    Ok(Err(_)) | Err(_) => Err(self.post_mortem()),
                };
            }
        }
    }

    /// Why the probe ended. Its words are diagnosis only: no verdict here earns a point.
    fn post_mortem(&mut self) -> Fault {
        // It may have closed its pipe and live on.
        let deadline = Instant::now() + EXIT_TIMEOUT;
        let ended = loop {
            match self.process.exit_reason() {
                None if Instant::now() < deadline => thread::sleep(Duration::from_millis(1)),
                ended => break ended,
            }
        };
        if ended.is_some_and(ExitReason::is_external_kill) {
            return match self.memory > Launcher::LARGE_MEMORY {
                true => Fault::OutOfMemory,
                false => Fault::Crashed(Crash::Killed),
            };
        }
        let ending = self.process.kill();
        self.output.wait_for_end(OUTPUT_TIMEOUT);
        let words = self.output.head();
        match ending {
            Some(ExitReason::Code(code)) => Fault::Crashed(Crash::Exited(code)),
            // The runtime's own words, on its way out.
            Some(ExitReason::Signal(_)) if words.contains(STACK_OVERFLOW) => {
                Fault::Crashed(Crash::StackOverflow)
            }
            Some(ExitReason::Signal(_)) if words.contains(OUT_OF_MEMORY) => Fault::OutOfMemory,
            Some(ExitReason::Signal(signal)) => Fault::Crashed(Crash::Signal(signal)),
            None => Fault::Crashed(Crash::Signal(0)),
        }
    }
}

/// Nothing that a submission could know or guess.
fn nonces(count: usize) -> Vec<u64> {
    let mut bytes = vec![0; 8 * count];
    getrandom::fill(&mut bytes).expect("the system has random numbers");
    let (nonces, _) = bytes.as_chunks();
    nonces
        .iter()
        .map(|nonce| u64::from_le_bytes(*nonce))
        .collect()
}

fn protocol_fault(error: WireError) -> Fault {
    Fault::Protocol(error.to_string())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn kills_a_program_that_closes_its_pipe_and_keeps_running() {
        use std::os::unix::fs::PermissionsExt;

        // Length and number of a question are those of its answer; the fifth kind asks nothing more.
        let script = "#!/bin/sh\nhead -c 12\nprintf '\\005'\nexec 1>&-\nexec sleep 600\n";
        let folder = tempfile::TempDir::new().unwrap();
        let program = folder.path().join("program");
        std::fs::write(&program, script).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let launcher = Launcher {
            program,
            sandbox: Sandbox::none(),
        };
        let budget = Budget {
            cpu: Duration::from_secs(10),
        };
        let mut probe = launcher.start(budget).unwrap();
        let began = Instant::now();
        let fault = probe.ask([], budget).unwrap_err();
        assert!(
            matches!(fault, Fault::Crashed(Crash::Signal(_))),
            "{fault:?}"
        );
        assert!(began.elapsed() < budget.wall());
        assert!(probe.process.exit_reason().is_some());
    }

    #[test]
    fn a_program_that_fails_to_start_is_a_grader_error() {
        let launcher = Launcher {
            program: "/usr/bin/false".into(),
            sandbox: Sandbox::none(),
        };
        let budget = Budget {
            cpu: Duration::from_secs(1),
        };
        let error = launcher.start(budget).expect_err("it says nothing");
        assert!(
            error.to_string().contains("nothing was asked yet"),
            "{error}"
        );
    }
}
