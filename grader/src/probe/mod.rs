//! Starts probes and exchanges questions and answers with them. Nothing a probe does can block the
//! grader.

mod budget;
mod culprit;
mod fault;
mod interrupt;
mod limits;
mod program;
mod shrink;
mod streams;

use std::io;
use std::mem;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use protocol::wire::{self, Frame, WireError};
use protocol::{Answer, Question};

use crate::machine::system::Limits;
use crate::sandbox::Sandbox;

pub use budget::{Allowance, Budget};
pub use culprit::Culprit;
pub use fault::{Crash, Fault, TimeLimit};
pub use interrupt::Interrupt;
pub use limits::{ItemLimits, Stopwatch, TimeUsed};
pub use program::RunningProgram;
pub use shrink::smallest_overflow;
pub use streams::Batch;

/// The time limits for starting a program. They are generous, because none of the submission's code
/// runs yet.
pub const START_LIMITS: ItemLimits = ItemLimits {
    waiting: Duration::from_secs(30),
    ..ItemLimits::from_cpu(Duration::from_secs(10))
};

/// A running probe.
#[derive(Debug)]
pub struct Probe {
    program: RunningProgram,
    /// Maximum observed memory use, in bytes.
    memory: u64,
    /// Time used for questions.
    used: TimeUsed,
    interrupt: Interrupt,
    /// The fault that kept the probe from starting, if any. A probe that didn't start answers no
    /// questions.
    not_started: Option<Fault>,
}

/// Starts the probes of one submission.
#[derive(Clone, Debug)]
pub struct Launcher {
    /// Path of the program to start.
    pub program: PathBuf,
    /// The sandbox that the program runs in.
    pub sandbox: Sandbox,
    /// A request to stop the launcher's probes early.
    pub interrupt: Interrupt,
}

impl Launcher {
    /// Maximum address space of a probe, in bytes. This includes 64 MiB for its stack.
    pub const MEMORY_LIMIT: u64 = 1 << 30;
    /// Memory use, in bytes, above which a probe that was killed is considered to have run out of
    /// memory. Correct solutions use less than half of this.
    pub const LARGE_MEMORY: u64 = Self::MEMORY_LIMIT / 4;

    /// Starts a probe that waits for questions. `cpu` is the total CPU time that the probe may use.
    /// A probe that exceeds this limit is killed even if the grader itself has already been killed.
    ///
    /// None of the submission's code runs before the first question, but the submission's static
    /// variables may need too much memory. If the program fails before that question, all questions
    /// result in [`Crash::NotStarted`]. Returns an error if the launcher fails or the system cannot
    /// create a process. A submission can cause neither of these.
    pub fn start(&self, cpu: Duration) -> io::Result<Probe> {
        let limits = Limits {
            memory: Self::MEMORY_LIMIT,
            data: None,
            cpu: cpu + START_LIMITS.cpu,
            file: 0,
        }
        .within_available_memory(Self::LARGE_MEMORY);
        let mut probe = Probe {
            program: RunningProgram::start(&self.program, &self.sandbox, limits)?,
            memory: 0,
            used: TimeUsed::default(),
            interrupt: Interrupt::default(),
            not_started: None,
        };
        if probe.ask([], START_LIMITS).is_err() {
            probe.program.process.kill();
            probe.not_started = Some(Fault::Crashed(Crash::NotStarted));
        }
        // Set this only now, so that an interrupted start doesn't look like a failed one.
        probe.interrupt = self.interrupt.clone();
        Ok(probe)
    }
}

impl Probe {
    /// Sends all questions at once and receives the answers. After a fault, the probe cannot be
    /// used again.
    pub fn ask<'a>(
        &mut self,
        questions: impl IntoIterator<Item = &'a Question>,
        limits: ItemLimits,
    ) -> Result<Vec<Answer>, Fault> {
        if let Some(fault) = &self.not_started {
            return Err(fault.clone());
        }
        let questions: Vec<&Question> = questions.into_iter().collect();
        let mut nonces = nonces(questions.len() + 1);
        let end = nonces
            .pop()
            .expect("there is one more nonce than there are questions");
        let mut batch = Batch::default();
        for (nonce, question) in nonces.iter().zip(questions) {
            let append = |frames| wire::append_question(frames, *nonce, question);
            batch.add(question.max_answer_bytes(), append)?;
            if batch.is_full() {
                self.program.send(mem::take(&mut batch));
            }
        }
        batch.add(0, |frames| Ok(wire::append_end(frames, end)))?;
        self.program.send(batch);

        let mut stopwatch = Stopwatch::start(limits);
        let answers = self.receive(nonces, end, &mut stopwatch);
        self.used += stopwatch.used();
        answers
    }

    /// Receives the answers with these nonces, followed by the end frame with the nonce `end`.
    fn receive(
        &mut self,
        nonces: Vec<u64>,
        end: u64,
        stopwatch: &mut Stopwatch,
    ) -> Result<Vec<Answer>, Fault> {
        let printed_before = self.program.printed();
        let mut answers = Vec::with_capacity(nonces.len());
        for nonce in nonces {
            let frame = self.next_frame(stopwatch, printed_before)?;
            answers.push(answer_to(nonce, &frame)?);
        }
        let frame = self.next_frame(stopwatch, printed_before)?;
        if frame.nonce == end && frame.is_end() {
            Ok(answers)
        } else {
            Err(no_question())
        }
    }

    /// Ends the probe. Returns the beginning of the submission's output, without the messages of
    /// the Rust runtime.
    pub fn finish(self) -> String {
        self.program.finish()
    }

    /// Returns the time used since the last call and resets it to zero.
    pub fn take_time_used(&mut self) -> TimeUsed {
        mem::take(&mut self.used)
    }

    fn next_frame(
        &mut self,
        stopwatch: &mut Stopwatch,
        printed_before: u64,
    ) -> Result<Frame, Fault> {
        loop {
            let asked_at = Instant::now();
            match self.program.next_frame() {
                Ok(Some(frame)) => return Ok(frame),
                Ok(None) => {}
                Err(fault) => {
                    self.used.waiting += asked_at.elapsed();
                    let is_killed = fault == Fault::Crashed(Crash::Killed);
                    let is_memory = is_killed && self.memory > Launcher::LARGE_MEMORY;
                    return Err(if is_memory { Fault::OutOfMemory } else { fault });
                }
            }
            let printed = self.program.printed() - printed_before;
            let process = &mut self.program.process;
            self.memory = self.memory.max(process.memory().unwrap_or(0));
            let exceeded = stopwatch.exceeded(process.time(), printed);
            let interrupted = (self.interrupt.is_requested()).then_some(TimeLimit::Wall);
            if let Some(over) = exceeded.or(interrupted) {
                process.kill();
                return Err(Fault::TimedOut(over));
            }
        }
    }
}

/// Returns random numbers that a submission cannot guess.
fn nonces(count: usize) -> Vec<u64> {
    let mut bytes = vec![0; 8 * count];
    getrandom::fill(&mut bytes).expect("the system provides random numbers");
    let (nonces, _) = bytes.as_chunks();
    nonces
        .iter()
        .map(|nonce| u64::from_le_bytes(*nonce))
        .collect()
}

/// Returns the answer in a frame, which must belong to the question with this nonce.
fn answer_to(nonce: u64, frame: &Frame) -> Result<Answer, Fault> {
    if frame.nonce != nonce {
        return Err(no_question());
    }
    frame.answer().map_err(protocol_fault)
}

fn no_question() -> Fault {
    Fault::Protocol("an answer that does not match any question".to_owned())
}

fn protocol_fault(error: WireError) -> Fault {
    Fault::Protocol(error.to_string())
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::PermissionsExt;

    use tempfile::TempDir;

    use super::*;

    fn launcher(program: PathBuf) -> Launcher {
        Launcher {
            program,
            sandbox: Sandbox::none(),
            interrupt: Interrupt::default(),
        }
    }

    /// Starts a program that echoes the first frame, which marks the end of an empty list of
    /// questions, and then runs these commands.
    fn start_script(commands: &str) -> (TempDir, Launcher, Probe) {
        let folder = TempDir::new().unwrap();
        let program = folder.path().join("program");
        let script = format!("#!/bin/sh\nhead -c 12\n{commands}\n");
        std::fs::write(&program, script).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let launcher = launcher(program);
        let probe = launcher.start(START_LIMITS.cpu).unwrap();
        (folder, launcher, probe)
    }

    #[test]
    fn kills_a_program_that_closes_its_pipe_and_keeps_running() {
        let (_folder, _, mut probe) = start_script("exec 1>&-\nexec sleep 600");
        let started_at = Instant::now();
        let fault = probe.ask([], START_LIMITS).unwrap_err();
        let is_signal = matches!(fault, Fault::Crashed(Crash::Signal(_)));
        assert!(is_signal, "{fault:?}");
        assert!(started_at.elapsed() < START_LIMITS.waiting);
        assert!(probe.take_time_used().waiting >= program::EXIT_TIMEOUT);
        assert!(probe.program.process.exit_reason().is_some());
    }

    #[test]
    fn an_interrupt_ends_a_program_that_answers_nothing() {
        let (_folder, launcher, mut probe) = start_script("exec sleep 600");
        launcher.interrupt.request();
        let fault = probe.ask([], START_LIMITS).unwrap_err();
        assert_eq!(fault, Fault::TimedOut(TimeLimit::Wall));
        assert!(probe.take_time_used().waiting < START_LIMITS.waiting / 2);
    }

    #[test]
    fn a_program_that_fails_to_start_answers_nothing() {
        let mut probe = launcher("/usr/bin/false".into())
            .start(Duration::from_secs(1))
            .unwrap();
        let answered = probe.ask([], START_LIMITS);
        assert_eq!(answered, Err(Fault::Crashed(Crash::NotStarted)));
    }
}
