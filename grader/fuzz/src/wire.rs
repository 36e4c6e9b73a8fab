//! Frames: the only thing that comes out of a submission's process.

use protocol::wire::{self, WireError};
use protocol::{Answer, Question};

/// What a question of a thousand elements allows.
const LIMIT: usize = 80 << 10;

/// As many frames as there are, each as an answer and as a question.
pub fn read(bytes: &[u8]) {
    let mut rest = bytes;
    loop {
        let frame = match wire::read(&mut rest, LIMIT) {
            Ok(frame) => frame,
            Err(WireError::EndOfStream | WireError::TooLong { .. }) => return,
            Err(error) => panic!("reading from memory can not fail: {error}"),
        };
        // What can be read can be written, and then reads the same: but for NaN, bit by bit.
        if let Ok(answer) = frame.decode::<Answer>() {
            assert_round_trip(&answer);
        }
        if let Ok(question) = frame.decode::<Question>() {
            assert_round_trip(&question);
            let _ = (question.count(), question.max_answer_bytes());
        }
    }
}

fn assert_round_trip<T: serde::Serialize + serde::de::DeserializeOwned>(value: &T) {
    let bytes = wire::encode(7, value).expect("what was read can be written");
    let frame = wire::read(&mut bytes.as_slice(), bytes.len()).expect("a frame");
    let again = wire::encode(7, &frame.decode::<T>().expect("the same")).expect("the same");
    assert_eq!(bytes, again);
}
