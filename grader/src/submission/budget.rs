//! The limits on what collecting one submission may read, in total, over all of its folders and
//! archives, and archives in archives. They are numbers of files and bytes, and not times, so that they
//! do not depend on the machine.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

use super::limited_reader::ByteBudget;

/// The maximum number of files and folders that are listed, in folders and in archives.
const MAX_FILES: usize = 50_000;
/// The maximum number of archives that are opened.
const MAX_ARCHIVES: usize = 32;
/// The maximum number of folders with task files.
const MAX_FOLDERS: usize = 64;
/// The maximum number of files whose names resemble those of task files.
const MAX_COPIES: usize = 200;
/// The maximum number of bytes that are read from archives, compressed and inflated.
const MAX_BYTES: u64 = 1 << 30;

/// A limited quantity of a submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Limit {
    /// Files and folders, in folders and in archives.
    Files,
    /// Levels of folders inside each other.
    Levels,
    /// Archives.
    Archives,
    /// Folders with task files.
    Folders,
    /// Files whose names resemble those of task files.
    Copies,
    /// Bytes in archives.
    Bytes,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Limit::Files => write!(f, "too many files and folders (more than {MAX_FILES})"),
            Limit::Levels => write!(f, "too many files and folders inside each other"),
            Limit::Archives => write!(f, "too many archives (more than {MAX_ARCHIVES})"),
            Limit::Folders => write!(
                f,
                "too many folders with task files (more than {MAX_FOLDERS})"
            ),
            Limit::Copies => write!(f, "too many copies of task files (more than {MAX_COPIES})"),
            Limit::Bytes => write!(
                f,
                "too many bytes in its archives (more than {} MiB)",
                MAX_BYTES >> 20
            ),
        }
    }
}

impl Limit {
    /// Returns how many things of this kind may be read, if they are counted by [`Budget::spend`].
    fn most(self) -> usize {
        match self {
            Limit::Files => MAX_FILES,
            Limit::Archives => MAX_ARCHIVES,
            Limit::Folders => MAX_FOLDERS,
            Limit::Copies => MAX_COPIES,
            Limit::Levels | Limit::Bytes => 0,
        }
    }
}

/// The amounts that have been read of a submission.
#[derive(Debug)]
pub(super) struct Budget {
    /// The number of things of each kind.
    counts: RefCell<BTreeMap<Limit, usize>>,
    /// The bytes that may still be read from archives.
    pub(super) bytes: ByteBudget,
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            counts: RefCell::default(),
            bytes: ByteBudget::new(MAX_BYTES),
        }
    }
}

impl Budget {
    /// Counts things. Fails if there are more of them than may be read.
    pub(super) fn spend(&self, limit: Limit, count: usize) -> Result<(), Limit> {
        let mut counts = self.counts.borrow_mut();
        let spent = counts.entry(limit).or_default();
        *spent = spent.saturating_add(count);
        if *spent > limit.most() {
            Err(limit)
        } else {
            Ok(())
        }
    }

    /// Fails if all bytes have been read.
    pub(super) fn check_bytes(&self) -> Result<(), Limit> {
        if self.bytes.is_exhausted() {
            Err(Limit::Bytes)
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_the_limit_are_read() {
        for (limit, most) in [
            (Limit::Files, MAX_FILES),
            (Limit::Archives, MAX_ARCHIVES),
            (Limit::Folders, MAX_FOLDERS),
            (Limit::Copies, MAX_COPIES),
        ] {
            let budget = Budget::default();
            assert_eq!(budget.spend(limit, most), Ok(()));
            assert_eq!(budget.spend(limit, 0), Ok(()));
            assert_eq!(budget.spend(limit, 1), Err(limit));
            assert_eq!(budget.check_bytes(), Ok(()));
        }
    }
}
