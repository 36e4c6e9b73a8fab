//! Writes archives.

use std::collections::BTreeSet;
use std::io::{self, Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipWriter};

use crate::names::unique_name;

/// An archive that is being written in memory.
pub struct ArchiveWriter {
    writer: ZipWriter<Cursor<Vec<u8>>>,
    /// The names already used in the archive, in lower case.
    used: BTreeSet<String>,
}

impl Default for ArchiveWriter {
    /// Returns an empty archive.
    fn default() -> Self {
        ArchiveWriter {
            writer: ZipWriter::new(Cursor::new(Vec::new())),
            used: BTreeSet::new(),
        }
    }
}

impl ArchiveWriter {
    /// Adds a file. If the name is taken, a number is appended to its stem. The file gets no
    /// modification time, so that the archive depends only on the files' contents.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let (stem, end) = name.split_at(name.rfind('.').unwrap_or(name.len()));
        let free = unique_name(stem, end, &mut self.used);
        let options = SimpleFileOptions::default().last_modified_time(DateTime::default());
        self.writer.start_file(free, options)?;
        self.writer.write_all(bytes)
    }

    /// Returns the number of files.
    pub fn count(&self) -> usize {
        self.used.len()
    }

    /// Returns the bytes of the archive.
    pub fn finish(self) -> io::Result<Vec<u8>> {
        Ok(self.writer.finish()?.into_inner())
    }
}
