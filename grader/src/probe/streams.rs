//! The two threads beside a probe's pipe. A probe that never reads must not block our writing, and one
//! that never answers must not block our clock.
//!
//! Questions and answers cross in batches: a system call, or waking a thread, costs as much as many
//! questions.

use std::io::{BufReader, Read, Write};
use std::mem;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;
use std::vec;

use protocol::Question;
use protocol::wire::{self, Frame, WireError};

/// As much as a pipe holds.
const BATCH_BYTES: usize = 1 << 16;

/// Questions that go out as one.
#[derive(Debug, Default)]
pub(super) struct Batch {
    frames: Vec<u8>,
    /// Of each question, the longest answer that is taken.
    limits: Vec<usize>,
}

impl Batch {
    /// One more.
    pub(super) fn add(&mut self, nonce: u64, question: &Question) -> Result<(), WireError> {
        self.frames = wire::append_question(mem::take(&mut self.frames), nonce, question)?;
        self.limits.push(question.max_answer_bytes());
        Ok(())
    }

    /// Whether it is time to send it.
    pub(super) fn is_full(&self) -> bool {
        self.frames.len() >= BATCH_BYTES
    }
}

/// Both directions.
#[derive(Debug)]
pub(super) struct Streams {
    questions: Sender<Vec<u8>>,
    limits: Sender<Vec<usize>>,
    answers: Receiver<Result<Vec<Frame>, WireError>>,
    /// What has come, and was not asked for yet.
    received: vec::IntoIter<Frame>,
}

impl Streams {
    /// Begins to write and to read; both end with the pipe, or with this.
    pub(super) fn open(
        stdin: impl Write + Send + 'static,
        stdout: impl Read + Send + 'static,
    ) -> Self {
        let (questions, to_write) = channel();
        let (limits, to_read) = channel();
        let (answered, answers) = channel();
        thread::spawn(move || write(stdin, to_write));
        thread::spawn(move || read(stdout, to_read, answered));
        Streams {
            questions,
            limits,
            answers,
            received: Vec::new().into_iter(),
        }
    }

    /// Sends these questions. If a thread has gone, what it should have read is missed later.
    pub(super) fn send(&self, batch: Batch) {
        self.limits.send(batch.limits).ok();
        self.questions.send(batch.frames).ok();
    }

    /// The next answer, whatever it is.
    pub(super) fn next(
        &mut self,
        patience: Duration,
    ) -> Result<Result<Frame, WireError>, RecvTimeoutError> {
        loop {
            if let Some(frame) = self.received.next() {
                return Ok(Ok(frame));
            }
            match self.answers.recv_timeout(patience)? {
                Ok(frames) => self.received = frames.into_iter(),
                Err(error) => return Ok(Err(error)),
            }
        }
    }
}

fn write(mut stdin: impl Write, batches: Receiver<Vec<u8>>) {
    for frames in batches {
        if stdin
            .write_all(&frames)
            .and_then(|()| stdin.flush())
            .is_err()
        {
            return; // Whoever waits for the answer sees that it ended.
        }
    }
}

fn read(
    stdout: impl Read,
    batches: Receiver<Vec<usize>>,
    answered: Sender<Result<Vec<Frame>, WireError>>,
) {
    let mut stdout = BufReader::with_capacity(BATCH_BYTES, stdout);
    for limits in batches {
        let mut here = Vec::new();
        for limit in limits {
            // What has come is handed on before anybody waits for more.
            if stdout.buffer().is_empty() && !here.is_empty() {
                answered.send(Ok(mem::take(&mut here))).ok();
            }
            match wire::read(&mut stdout, limit) {
                Ok(frame) => here.push(frame),
                Err(error) => {
                    answered.send(Ok(here)).ok();
                    answered.send(Err(error)).ok();
                    return;
                }
            }
        }
        if answered.send(Ok(here)).is_err() {
            return;
        }
    }
}
