//! A cache of compiled programs by the hash of their inputs, for tools that build the same
//! submissions repeatedly. Normal grading does not use it: it always compiles.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A folder of compiled programs.
#[derive(Clone, Debug)]
pub struct ProgramCache {
    folder: PathBuf,
}

/// A hash of a program's inputs.
#[derive(Debug, Default)]
pub struct ContentHash(blake2b_simd::State);

impl ContentHash {
    /// Adds an input to the hash.
    pub fn with(mut self, part: &[u8]) -> Self {
        self.0.update(&(part.len() as u64).to_le_bytes());
        self.0.update(part);
        self
    }

    /// Returns the hash in hexadecimal.
    pub fn hex(&self) -> String {
        self.0.finalize().to_hex()[..32].to_owned()
    }
}

impl ProgramCache {
    /// Creates a cache in this folder, which is created if necessary.
    pub fn new(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
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
        // Moved instead of copied: the file is complete at any time, and never open for writing
        // when run.
        fs::rename(program, &path)?;
        Ok(path)
    }
}
