//! The probe: the process that contains a submission and answers the grader's questions.
//!
//! It receives questions, but never the correct answers. Only its answers earn points. Its exit
//! code and its output are only used for diagnosis.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Write};
use std::process::ExitCode;
use std::thread;

use protocol::wire::{self, WireError};

use crate::harness::answer;
use crate::harness::attempt::keep_panics_quiet;
use crate::harness::system::{claim_standard_streams, end_with_the_grader};
use crate::submission::Submission;

/// The stack size of the thread that runs a submission's code.
pub const STACK_BYTES: usize = 64 << 20;

/// The maximum size of a question. The grader is trusted, so this only guards against bugs.
const MAX_QUESTION_BYTES: usize = 256 << 20;

/// Answers questions from standard input until the input ends.
pub fn main(submission: &dyn Submission) -> ExitCode {
    run(|questions, answers| serve(submission, questions, answers))
}

/// Runs `serve` with the pipes for questions and answers, on a thread with a large stack. Returns
/// the exit code of the process. Panics in an [`attempt`](crate::harness::attempt::attempt) print
/// nothing.
pub fn run(serve: impl FnOnce(File, File) -> Result<(), WireError> + Send) -> ExitCode {
    end_with_the_grader();
    let (questions, answers) = match claim_standard_streams() {
        Ok(streams) => streams,
        Err(error) => {
            eprintln!("probe: cannot redirect the standard streams: {error}");
            return ExitCode::from(3);
        }
    };
    keep_panics_quiet();
    let served = thread::scope(|scope| {
        thread::Builder::new()
            .name("submission".to_owned())
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, || serve(questions, answers))
            .map(|thread| thread.join().unwrap_or(Err(WireError::EndOfStream)))
    });
    match served {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(error)) => {
            eprintln!("probe: {error}");
            ExitCode::from(3)
        }
        Err(error) => {
            eprintln!("probe: cannot start a thread: {error}");
            ExitCode::from(3)
        }
    }
}

/// Answers each question in turn. Answers are only flushed when no more questions are buffered, so
/// that a batch of questions costs a single context switch.
fn serve(
    submission: &dyn Submission,
    questions: impl Read,
    answers: impl Write,
) -> Result<(), WireError> {
    let mut questions = BufReader::with_capacity(1 << 16, questions);
    let mut answers = BufWriter::with_capacity(1 << 16, answers);
    loop {
        if questions.buffer().is_empty() {
            answers.flush()?;
        }
        let frame = match wire::read(&mut questions, MAX_QUESTION_BYTES) {
            Err(WireError::EndOfStream) => return Ok(()),
            read => read?,
        };
        if frame.is_end() {
            answers.write_all(&wire::append_end(Vec::new(), frame.nonce))?;
            continue;
        }
        let answer = answer::answer_question(submission, &frame.decode()?);
        wire::write(&mut answers, frame.nonce, &answer)?;
    }
}
