//! Frames, the only output of a submission's process that the grader parses.

use protocol::wire::{self, WireError};
use protocol::{Answer, Question};

/// The maximum length of an answer to a question with a thousand elements, in bytes.
const LIMIT: usize = 80 << 10;

/// Reads all frames in the bytes, each as an answer and as a question.
pub fn read(bytes: &[u8]) {
    let mut rest = bytes;
    loop {
        let frame = match wire::read(&mut rest, LIMIT) {
            Ok(frame) => frame,
            Err(WireError::EndOfStream | WireError::TooLong { .. }) => return,
            Err(error) => panic!("reading from memory cannot fail: {error}"),
        };
        // A decoded value can be encoded again. Compare the encodings rather than the values,
        // because NaN isn't equal to itself.
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
    let bytes = wire::encode(7, value).expect("a decoded value can be encoded");
    let frame = wire::read(&mut bytes.as_slice(), bytes.len()).expect("the frame can be read");
    let again = wire::encode(7, &frame.decode::<T>().expect("it decodes")).expect("it encodes");
    assert_eq!(bytes, again);
}
