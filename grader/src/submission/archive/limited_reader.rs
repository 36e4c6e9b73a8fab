//! A reader that limits the number of bytes actually read.

use std::cell::Cell;
use std::io::{self, Read};
use std::rc::Rc;

use rawzip::ReaderAt;

/// A reader that fails once its byte budget is used up.
#[derive(Debug)]
pub(super) struct LimitedReader<R> {
    inner: R,
    budget: ByteBudget,
}

/// The number of bytes that may still be read. Clones share the number, so that the owner of a
/// reader can check and reset it.
#[derive(Clone, Debug)]
pub(super) struct ByteBudget(Rc<Cell<u64>>);

impl ByteBudget {
    /// Returns whether no bytes are left.
    pub(super) fn is_exhausted(&self) -> bool {
        self.0.get() == 0
    }

    /// Sets the number of bytes left.
    pub(super) fn reset(&self, bytes: u64) {
        self.0.set(bytes);
    }

    /// Reads into as much of the buffer as the budget allows, and deducts the bytes read.
    fn read_within(
        &self,
        buffer: &mut [u8],
        read: impl FnOnce(&mut [u8]) -> io::Result<usize>,
    ) -> io::Result<usize> {
        if self.is_exhausted() && !buffer.is_empty() {
            return Err(io::Error::other("it has more bytes than may be read"));
        }
        let left = self.0.get();
        let most = usize::try_from(left)
            .unwrap_or(usize::MAX)
            .min(buffer.len());
        let count = read(&mut buffer[..most])?;
        self.reset(left - count as u64);
        Ok(count)
    }
}

impl<R> LimitedReader<R> {
    /// Limits `inner` to `bytes` bytes in total, at any offsets. Also returns the budget.
    pub(super) fn new(inner: R, bytes: u64) -> (Self, ByteBudget) {
        let budget = ByteBudget(Rc::new(Cell::new(bytes)));
        let reader = LimitedReader {
            inner,
            budget: budget.clone(),
        };
        (reader, budget)
    }
}

impl<R: Read> Read for LimitedReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let LimitedReader { inner, budget } = self;
        budget.read_within(buffer, |buffer| inner.read(buffer))
    }
}

impl<R: ReaderAt> ReaderAt for LimitedReader<R> {
    fn read_at(&self, buffer: &mut [u8], offset: u64) -> io::Result<usize> {
        let LimitedReader { inner, budget } = self;
        budget.read_within(buffer, |buffer| inner.read_at(buffer, offset))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_as_many_bytes_as_the_budget_has() {
        let (mut reader, budget) = LimitedReader::new(&b"hello"[..], 3);
        let mut buffer = [0; 2];
        assert_eq!(reader.read(&mut buffer).unwrap(), 2);
        assert_eq!(&buffer, b"he");
        assert!(!budget.is_exhausted());
        assert_eq!(reader.read(&mut buffer).unwrap(), 1);
        assert!(budget.is_exhausted());
        let error = reader.read(&mut buffer).unwrap_err();
        assert_eq!(error.to_string(), "it has more bytes than may be read");
        // Reading nothing is possible at any time.
        assert_eq!(reader.read(&mut []).unwrap(), 0);
        budget.reset(9);
        assert_eq!(reader.read(&mut buffer).unwrap(), 2);
        assert_eq!(&buffer, b"lo");
    }

    #[test]
    fn bytes_count_at_any_offset() {
        let (reader, budget) = LimitedReader::new(&b"hello"[..], 4);
        let mut buffer = [0; 3];
        assert_eq!(reader.read_at(&mut buffer, 2).unwrap(), 3);
        assert_eq!(&buffer, b"llo");
        assert_eq!(reader.read_at(&mut buffer, 0).unwrap(), 1);
        assert_eq!(buffer[0], b'h');
        assert!(budget.is_exhausted() && reader.read_at(&mut buffer, 0).is_err());
    }
}
