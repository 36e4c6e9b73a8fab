//! The threads that write to and read from a probe's pipes, so that a probe that never reads or
//! never answers doesn't block the grader.
//!
//! Questions and answers are exchanged in batches, because making a system call or waking a thread
//! takes as long as answering many questions.

use std::io::{BufReader, Read, Write};
use std::mem;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;
use std::vec;

use protocol::wire::{self, Frame, WireError};

use super::fault::Fault;

/// A batch is sent when it reaches this size, in bytes. This is the capacity of a pipe.
const BATCH_BYTES: usize = 1 << 16;

/// A batch of requests to send together.
#[derive(Debug, Default)]
pub struct Batch {
    frames: Vec<u8>,
    /// Maximum size of the response to each request.
    limits: Vec<usize>,
}

impl Batch {
    /// Adds a request, which `append` encodes and appends to the previous frames. The response may
    /// have at most `limit` bytes.
    pub fn add(
        &mut self,
        limit: usize,
        append: impl FnOnce(Vec<u8>) -> Result<Vec<u8>, WireError>,
    ) -> Result<(), Fault> {
        self.frames = append(mem::take(&mut self.frames))
            .map_err(|error| Fault::Protocol(format!("the question cannot be encoded: {error}")))?;
        self.limits.push(limit);
        Ok(())
    }

    /// Returns whether the batch should be sent.
    pub(super) fn is_full(&self) -> bool {
        self.frames.len() >= BATCH_BYTES
    }
}

/// The channels to the writing and reading threads.
#[derive(Debug)]
pub(super) struct Streams {
    questions: Sender<Vec<u8>>,
    limits: Sender<Vec<usize>>,
    answers: Receiver<Result<Vec<Frame>, WireError>>,
    /// Frames that have been received but not yet returned to the caller.
    received: vec::IntoIter<Frame>,
}

impl Streams {
    /// Starts both threads. Each ends when its pipe is closed or this value is dropped.
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

    /// Sends a batch. If a thread has ended, the missing answer will be noticed later.
    pub(super) fn send(&self, batch: Batch) {
        self.limits.send(batch.limits).ok();
        self.questions.send(batch.frames).ok();
    }

    /// Returns the next frame, regardless of its contents.
    pub(super) fn next(
        &mut self,
        timeout: Duration,
    ) -> Result<Result<Frame, WireError>, RecvTimeoutError> {
        loop {
            if let Some(frame) = self.received.next() {
                return Ok(Ok(frame));
            }
            match self.answers.recv_timeout(timeout)? {
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
            return; // The reading thread notices that the pipe is closed.
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
        let mut frames = Vec::new();
        for limit in limits {
            // Pass on the received frames before waiting for more.
            if stdout.buffer().is_empty() && !frames.is_empty() {
                answered.send(Ok(mem::take(&mut frames))).ok();
            }
            match wire::read(&mut stdout, limit) {
                Ok(frame) => frames.push(frame),
                Err(error) => {
                    answered.send(Ok(frames)).ok();
                    answered.send(Err(error)).ok();
                    return;
                }
            }
        }
        if answered.send(Ok(frames)).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::iter;

    use proptest::prelude::*;
    use protocol::{Answer, ElementOutcome, Interval};

    use super::*;
    use crate::probe::answer_to;

    /// Returns an answer with this number of elements.
    fn answer(elements: usize) -> Answer {
        let times = ElementOutcome::Value(Some(Interval::new(1.0, 2.0)));
        Answer::Spans(vec![times; elements])
    }

    /// Returns the frames in order of arrival. `batches` are the sizes of the batches in which the
    /// questions are sent, and `pieces` are the sizes of the pieces in which the program writes
    /// `bytes`. After each piece, the program yields to other threads.
    fn received(
        bytes: Vec<u8>,
        limits: &[usize],
        batches: &[usize],
        pieces: Vec<usize>,
    ) -> Vec<Frame> {
        let (stdout, mut program) = io::pipe().unwrap();
        let mut streams = Streams::open(io::sink(), stdout);
        let mut unsent = limits;
        for &size in batches.iter().cycle() {
            let (limits, rest) = unsent.split_at(size.min(unsent.len()));
            let (frames, limits) = (Vec::new(), limits.to_vec());
            streams.send(Batch { frames, limits });
            unsent = rest;
            if unsent.is_empty() {
                break;
            }
        }
        let writer = thread::spawn(move || {
            let mut rest = bytes.as_slice();
            for size in pieces.into_iter().cycle() {
                let (piece, after) = rest.split_at(size.min(rest.len()));
                program.write_all(piece).unwrap();
                thread::yield_now();
                rest = after;
                if rest.is_empty() {
                    break;
                }
            }
        });
        let next = || streams.next(Duration::from_secs(60)).unwrap().ok();
        let frames = iter::from_fn(next).take(limits.len()).collect();
        writer.join().unwrap();
        frames
    }

    #[test]
    fn answers_before_an_invalid_one_are_received() {
        let append = |bytes, nonce| wire::append(bytes, nonce, &answer(1)).unwrap();
        let mut bytes = (0..3).fold(Vec::new(), append);
        bytes.extend([0xff; 64]);
        let (limits, all) = ([1000; 4], vec![bytes.len()]);
        let frames = received(bytes, &limits, &[4], all);
        let nonces: Vec<u64> = frames.iter().map(|frame| frame.nonce).collect();
        assert_eq!(nonces, [0, 1, 2]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn answers_do_not_depend_on_pieces_batches_and_threads(
            sizes in prop::collection::vec(0usize..3000, 1..40),
            batches in prop::collection::vec(1usize..9, 1..9),
            pieces in prop::collection::vec(1usize..20_000, 1..20),
        ) {
            let answers: Vec<Answer> = sizes.into_iter().map(answer).collect();
            let bodies = answers.iter().map(|answer| wire::encode(0, answer).unwrap().len());
            let limits: Vec<usize> = bodies.collect();
            let append = |bytes, (nonce, answer): (u64, &Answer)| {
                wire::append(bytes, nonce, answer).unwrap()
            };
            let bytes = (0..).zip(&answers).fold(Vec::new(), append);
            let frames = received(bytes, &limits, &batches, pieces);
            let found: Result<Vec<Answer>, _> =
                (0..).zip(&frames).map(|(nonce, frame)| answer_to(nonce, frame)).collect();
            prop_assert_eq!(found.unwrap(), answers);
        }

        #[test]
        fn answers_in_another_order_are_a_fault(
            order in Just(Vec::from_iter(0u64..9)).prop_shuffle(),
        ) {
            let frames = order.iter().map(|&nonce| {
                let frame = wire::encode(nonce, &answer(1)).unwrap();
                wire::read(&mut frame.as_slice(), frame.len()).unwrap()
            });
            let answered: Result<Vec<Answer>, _> =
                (0..).zip(frames).map(|(nonce, frame)| answer_to(nonce, &frame)).collect();
            prop_assert_eq!(answered.is_ok(), order.is_sorted());
        }
    }
}
