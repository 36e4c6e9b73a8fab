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
pub(super) struct ByteBudget {
    left: Rc<Cell<u64>>,
    /// The budget that this one is part of, if any.
    total: Option<Rc<Cell<u64>>>,
}

impl ByteBudget {
    /// Returns an independent budget.
    pub(super) fn new(bytes: u64) -> Self {
        ByteBudget {
            left: Rc::new(Cell::new(bytes)),
            total: None,
        }
    }

    /// Returns a budget that is part of this one. Bytes read are deducted from both.
    pub(super) fn part(&self, bytes: u64) -> Self {
        ByteBudget {
            left: Rc::new(Cell::new(bytes)),
            total: Some(Rc::clone(&self.left)),
        }
    }

    /// Returns whether no bytes are left.
    pub(super) fn is_exhausted(&self) -> bool {
        self.left() == 0
    }

    /// Sets the number of bytes left. The limit on the total still applies.
    pub(super) fn reset(&self, bytes: u64) {
        self.left.set(bytes);
    }

    /// Deducts bytes that were read or inflated.
    pub(super) fn spend(&self, bytes: u64) {
        for left in [Some(&self.left), self.total.as_ref()]
            .into_iter()
            .flatten()
        {
            left.set(left.get().saturating_sub(bytes));
        }
    }

    fn left(&self) -> u64 {
        let total = self.total.as_ref().map_or(u64::MAX, |total| total.get());
        self.left.get().min(total)
    }

    /// Reads into as much of the buffer as the budget allows. Deducts the bytes read.
    fn read_within(
        &self,
        buffer: &mut [u8],
        read: impl FnOnce(&mut [u8]) -> io::Result<usize>,
    ) -> io::Result<usize> {
        if self.is_exhausted() && !buffer.is_empty() {
            return Err(io::Error::other("it is larger than allowed"));
        }
        let most = usize::try_from(self.left())
            .unwrap_or(usize::MAX)
            .min(buffer.len());
        let count = read(&mut buffer[..most])?;
        self.spend(count as u64);
        Ok(count)
    }
}

impl<R> LimitedReader<R> {
    /// Limits the total number of bytes read from `inner`, at any offsets, to a budget.
    pub(super) fn new(inner: R, budget: &ByteBudget) -> Self {
        LimitedReader {
            inner,
            budget: budget.clone(),
        }
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
        let budget = ByteBudget::new(3);
        let mut reader = LimitedReader::new(&b"hello"[..], &budget);
        let mut buffer = [0; 2];
        assert_eq!(reader.read(&mut buffer).unwrap(), 2);
        assert_eq!(&buffer, b"he");
        assert!(!budget.is_exhausted());
        assert_eq!(reader.read(&mut buffer).unwrap(), 1);
        assert!(budget.is_exhausted());
        let error = reader.read(&mut buffer).unwrap_err();
        assert_eq!(error.to_string(), "it is larger than allowed");
        // Reading zero bytes is always possible.
        assert_eq!(reader.read(&mut []).unwrap(), 0);
        budget.reset(9);
        assert_eq!(reader.read(&mut buffer).unwrap(), 2);
        assert_eq!(&buffer, b"lo");
    }

    #[test]
    fn bytes_count_at_any_offset_and_in_the_total() {
        let total = ByteBudget::new(4);
        let reader = LimitedReader::new(&b"hello"[..], &total.part(9));
        let mut buffer = [0; 3];
        assert_eq!(reader.read_at(&mut buffer, 2).unwrap(), 3);
        assert_eq!(&buffer, b"llo");
        assert_eq!(reader.read_at(&mut buffer, 0).unwrap(), 1);
        assert_eq!(buffer[0], b'h');
        assert!(total.is_exhausted() && reader.read_at(&mut buffer, 0).is_err());
    }
}
