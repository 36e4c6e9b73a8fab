//! How questions and answers travel: frames of
//!
//! ```text
//!   length: u32 LE | nonce: u64 LE | body: `length` bytes, postcard
//! ```
//!
//! An answer echoes the nonce of its question. A reader states the longest body that it takes
//! *before* anything is allocated, and a body must be used up to its last byte.

use std::io::{self, Read, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{Answer, Question};

/// What is wrong with the bytes that came.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// The stream ended, inside a frame or between two.
    #[error("the stream ended")]
    EndOfStream,
    /// The stream failed.
    #[error("the stream failed: {0}")]
    Io(io::Error),
    /// The frame announces more than an honest one can hold.
    #[error("a frame of {length} bytes, where {limit} is the most")]
    TooLong {
        /// What the frame announces.
        length: usize,
        /// What was allowed.
        limit: usize,
    },
    /// The body is not an encoding of what was expected.
    #[error("a frame that can not be read: {0}")]
    Malformed(postcard::Error),
    /// The body goes on after its end.
    #[error("{0} bytes after the end of an answer")]
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

/// A frame as it came.
#[derive(Debug)]
pub struct Frame {
    /// Chosen by whoever asked.
    pub nonce: u64,
    /// The encoded value.
    pub body: Vec<u8>,
}

impl Frame {
    /// The answer in the frame. Compiled here, and so as fast as this crate is, whoever reads it.
    pub fn answer(&self) -> Result<Answer, WireError> {
        self.decode()
    }

    /// The value in the frame.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, WireError> {
        match postcard::take_from_bytes(&self.body).map_err(WireError::Malformed)? {
            (value, []) => Ok(value),
            (_, rest) => Err(WireError::TrailingBytes(rest.len())),
        }
    }
}

/// The bytes of a frame that holds `value`.
pub fn encode<T: Serialize>(nonce: u64, value: &T) -> Result<Vec<u8>, WireError> {
    append(Vec::new(), nonce, value)
}

/// These bytes, and after them a frame that holds `value`: many frames go out as one.
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

/// These bytes, and after them a frame with this question. Compiled here, as [`Frame::answer`] is.
pub fn append_question(
    bytes: Vec<u8>,
    nonce: u64,
    question: &Question,
) -> Result<Vec<u8>, WireError> {
    append(bytes, nonce, question)
}

/// Writes one frame; does not flush.
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
