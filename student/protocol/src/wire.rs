//! The wire format of questions and answers. Each is one frame:
//!
//! ```text
//!   length: u32 LE | nonce: u64 LE | body: `length` bytes, postcard
//! ```
//!
//! An answer repeats the nonce of its question. A frame without a body marks the end of the
//! questions. It is sent back unchanged, so that extra answers are detected. The reader specifies
//! the maximum length of a body. The length in the header is checked against this maximum *before*
//! anything is allocated. Decoding fails if there are bytes after the value.

use std::io::{self, Read, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{Answer, Question};

/// An error in reading or writing a frame.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// The stream ended, either within a frame or between two frames.
    #[error("the stream ended unexpectedly")]
    EndOfStream,
    /// Reading from or writing to the stream failed.
    #[error("reading or writing the stream failed: {0}")]
    Io(io::Error),
    /// The header states a length above the limit.
    #[error("a frame has {length} bytes, but the limit is {limit}")]
    TooLong {
        /// The length in the header, in bytes.
        length: usize,
        /// The maximum length, in bytes.
        limit: usize,
    },
    /// The body doesn't encode a value of the expected type.
    #[error("a frame cannot be decoded: {0}")]
    Malformed(postcard::Error),
    /// The body contains bytes after the end of the value.
    #[error("unexpected bytes after the value in a frame: {0}")]
    TrailingBytes(usize),
}

impl From<io::Error> for WireError {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::UnexpectedEof {
            WireError::EndOfStream
        } else {
            WireError::Io(error)
        }
    }
}

/// A frame that has been received but not yet decoded.
#[derive(Debug)]
pub struct Frame {
    /// A number chosen by the sender of the question. The answer repeats it.
    pub nonce: u64,
    /// The encoded value.
    pub body: Vec<u8>,
}

impl Frame {
    /// Returns whether the frame marks the end of the questions.
    pub fn is_end(&self) -> bool {
        self.body.is_empty()
    }

    /// Decodes the answer in the frame. This method isn't generic, so it is always compiled as part
    /// of this crate, with this crate's optimisation level.
    pub fn answer(&self) -> Result<Answer, WireError> {
        self.decode()
    }

    /// Decodes the value in the frame.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, WireError> {
        match postcard::take_from_bytes(&self.body).map_err(WireError::Malformed)? {
            (value, []) => Ok(value),
            (_, rest) => Err(WireError::TrailingBytes(rest.len())),
        }
    }
}

/// Encodes `value` as a frame.
pub fn encode<T: Serialize>(nonce: u64, value: &T) -> Result<Vec<u8>, WireError> {
    append(Vec::new(), nonce, value)
}

/// Encodes `value` as a frame and appends it to `bytes`, so that many frames can be sent in one
/// write.
pub fn append<T: Serialize>(
    mut bytes: Vec<u8>,
    nonce: u64,
    value: &T,
) -> Result<Vec<u8>, WireError> {
    const HEADER: [u8; 12] = [0; 12];
    let start = bytes.len();
    bytes.extend(HEADER);
    let mut bytes = postcard::to_extend(value, bytes).map_err(WireError::Malformed)?;
    let length = bytes.len() - start - HEADER.len();
    let announced = u32::try_from(length).map_err(|_| WireError::TooLong {
        length,
        limit: u32::MAX as usize,
    })?;
    let header = &mut bytes[start..];
    header[..4].copy_from_slice(&announced.to_le_bytes());
    header[4..12].copy_from_slice(&nonce.to_le_bytes());
    Ok(bytes)
}

/// Encodes a question as a frame and appends it to `bytes`. This function isn't generic, for the
/// same reason as [`Frame::answer`].
pub fn append_question(
    bytes: Vec<u8>,
    nonce: u64,
    question: &Question,
) -> Result<Vec<u8>, WireError> {
    append(bytes, nonce, question)
}

/// Appends the frame that marks the end of the questions.
pub fn append_end(mut bytes: Vec<u8>, nonce: u64) -> Vec<u8> {
    bytes.extend(0u32.to_le_bytes());
    bytes.extend(nonce.to_le_bytes());
    bytes
}

/// Writes one frame, without flushing.
pub fn write<T: Serialize>(out: &mut impl Write, nonce: u64, value: &T) -> Result<(), WireError> {
    Ok(out.write_all(&encode(nonce, value)?)?)
}

/// Reads one frame whose body has at most `limit` bytes.
pub fn read(from: &mut impl Read, limit: usize) -> Result<Frame, WireError> {
    let mut header = [0; 12];
    from.read_exact(&mut header)?;
    let (length, nonce) = header.split_at(4);
    let length = u32::from_le_bytes(length.try_into().expect("four bytes")) as usize;
    let nonce = u64::from_le_bytes(nonce.try_into().expect("eight bytes"));
    if length > limit {
        return Err(WireError::TooLong { length, limit });
    }
    let mut body = vec![0; length];
    from.read_exact(&mut body)?;
    Ok(Frame { nonce, body })
}
