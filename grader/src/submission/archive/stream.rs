//! Bytes that are counted where they really come from.

use std::cell::Cell;
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

/// Gives so many bytes and not one more.
#[derive(Debug)]
pub(super) struct Stream<R> {
    inner: R,
    left: Rc<Cell<u64>>,
}

/// How much may still be read, known outside of the stream.
#[derive(Clone, Debug)]
pub(super) struct Allowance(Rc<Cell<u64>>);

impl Allowance {
    /// Whether nothing is left of it.
    pub(super) fn is_used_up(&self) -> bool {
        self.0.get() == 0
    }

    /// From now on so many bytes.
    pub(super) fn renew(&self, bytes: u64) {
        self.0.set(bytes);
    }
}

impl<R> Stream<R> {
    /// At most `bytes` of `inner`, wherever in it they stand.
    pub(super) fn new(inner: R, bytes: u64) -> (Self, Allowance) {
        let left = Rc::new(Cell::new(bytes));
        let allowance = Allowance(Rc::clone(&left));
        (Stream { inner, left }, allowance)
    }
}

impl<R: Read> Read for Stream<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = self.left.get();
        if left == 0 && !buffer.is_empty() {
            return Err(io::Error::other("there is more of it than may be read"));
        }
        let most = usize::try_from(left)
            .unwrap_or(usize::MAX)
            .min(buffer.len());
        let read = self.inner.read(&mut buffer[..most])?;
        self.left.set(left - read as u64);
        Ok(read)
    }
}

impl<R: Seek> Seek for Stream<R> {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.inner.seek(place)
    }
}
