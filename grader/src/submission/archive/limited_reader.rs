//! Bytes that are counted where they really come from.

use std::cell::Cell;
use std::io::{self, Read};
use std::rc::Rc;

use rawzip::ReaderAt;

/// Gives so many bytes and not one more.
#[derive(Debug)]
pub(super) struct LimitedReader<R> {
    inner: R,
    budget: ByteBudget,
}

/// How much may still be read, known outside of the stream.
#[derive(Clone, Debug)]
pub(super) struct ByteBudget(Rc<Cell<u64>>);

impl ByteBudget {
    /// Whether nothing is left of it.
    pub(super) fn is_exhausted(&self) -> bool {
        self.0.get() == 0
    }

    /// From now on so many bytes.
    pub(super) fn reset(&self, bytes: u64) {
        self.0.set(bytes);
    }

    /// Takes from it what is read into that part of the buffer that it allows.
    fn read_within(
        &self,
        buffer: &mut [u8],
        read: impl FnOnce(&mut [u8]) -> io::Result<usize>,
    ) -> io::Result<usize> {
        if self.is_exhausted() && !buffer.is_empty() {
            return Err(io::Error::other("there is more of it than may be read"));
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
    /// At most `bytes` of `inner`, wherever in it they stand.
    pub(super) fn new(inner: R, bytes: u64) -> (Self, ByteBudget) {
        let left = ByteBudget(Rc::new(Cell::new(bytes)));
        let allowance = left.clone();
        (
            LimitedReader {
                inner,
                budget: left,
            },
            allowance,
        )
    }
}

impl<R: Read> Read for LimitedReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let LimitedReader {
            inner,
            budget: left,
        } = self;
        left.read_within(buffer, |buffer| inner.read(buffer))
    }
}

impl<R: ReaderAt> ReaderAt for LimitedReader<R> {
    fn read_at(&self, buffer: &mut [u8], place: u64) -> io::Result<usize> {
        let LimitedReader {
            inner,
            budget: left,
        } = self;
        left.read_within(buffer, |buffer| inner.read_at(buffer, place))
    }
}
