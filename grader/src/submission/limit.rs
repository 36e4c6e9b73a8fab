//! The limits on reading one submission, in total over all of its folders, archives and nested
//! archives. They apply to the numbers of files and bytes rather than to time, so that they don't
//! depend on the machine.

use std::fmt;

/// A quantity that is limited for each submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Limit {
    /// Files and folders, in folders and in archives.
    Files,
    /// Levels of nested folders.
    Levels,
    /// Archives.
    Archives,
    /// Folders with task files.
    Folders,
    /// Files whose names resemble those of task files.
    Copies,
    /// Bytes read from archives, compressed and inflated.
    Bytes,
}

impl Limit {
    /// Returns the maximum quantity.
    pub(super) fn most(self) -> usize {
        match self {
            Limit::Files => 50_000,
            Limit::Levels => 12,
            Limit::Archives => 32,
            Limit::Folders => 64,
            Limit::Copies => 200,
            Limit::Bytes => 1 << 30,
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let most = self.most();
        let things = match self {
            Limit::Files => "files and folders",
            Limit::Levels => return f.write_str("too many levels of nested folders"),
            Limit::Archives => "archives",
            Limit::Folders => "folders with task files",
            Limit::Copies => "copies of task files",
            Limit::Bytes => {
                let mebibytes = most >> 20;
                return write!(
                    f,
                    "too much data in its archives (more than {mebibytes} MiB)"
                );
            }
        };
        write!(f, "too many {things} (more than {most})")
    }
}
