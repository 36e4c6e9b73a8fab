//! A cache of compiled programs, with hashes of their inputs as keys, for tools that build the same
//! submissions repeatedly. Normal grading always compiles and does not use it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use judging::content_hash::ContentHash;

use crate::machine::files::{self, PathError};

/// A folder of compiled programs.
#[derive(Clone, Debug)]
pub struct ProgramCache {
    folder: PathBuf,
}

impl ProgramCache {
    /// Opens the cache in this folder, and creates the folder if necessary.
    pub fn new(folder: &Path) -> Result<Self, PathError> {
        files::create_dir_all(folder)?;
        Ok(ProgramCache {
            folder: folder.to_owned(),
        })
    }

    /// Returns the cached program with this hash, if there is one.
    pub fn find(&self, content: &ContentHash) -> Option<PathBuf> {
        let path = self.folder.join(content.hex());
        path.is_file().then_some(path)
    }

    /// Stores a program and returns its new path.
    pub fn store(&self, content: &ContentHash, program: &Path) -> io::Result<PathBuf> {
        let path = self.folder.join(content.hex());
        // Moved instead of copied, so that the file is always complete and never executed while it
        // is open for writing.
        fs::rename(program, &path)?;
        Ok(path)
    }
}
