//! `.zip` archives. The central directory at the end lists the contents, and only requested members
//! are inflated.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use rawzip::FileReader;

use crate::zipfile::{EntryKind, Zip, ZipError};

use super::limited_reader::ByteBudget;
use super::{
    ArchiveError, LimitedReader, Listing, MAX_MEMBERS, Member, display_name, io_error,
    normalize_path,
};

/// The maximum number of bytes to read for a list of the contents. This is about the size of a
/// central directory with 50,000 members.
const MAX_DIRECTORY_BYTES: u64 = 8 << 20;

/// A zip archive whose central directory has been read.
#[derive(Debug)]
pub(super) struct ZipReader {
    zip: Zip<LimitedReader<FileReader>>,
    budget: ByteBudget,
}

impl ZipReader {
    pub(super) fn open(path: &Path) -> Result<Self, ArchiveError> {
        let file = File::open(path).map_err(io_error)?;
        let length = file.metadata().map_err(io_error)?.len();
        let (reader, budget) = LimitedReader::new(FileReader::from(file), MAX_DIRECTORY_BYTES);
        let zip = Zip::open(reader, length, MAX_MEMBERS).map_err(|error| {
            if budget.is_exhausted() {
                ArchiveError::TooManyFiles
            } else {
                archive_error(&error, "")
            }
        })?;
        Ok(ZipReader { zip, budget })
    }

    pub(super) fn listing(&mut self) -> Result<Listing, ArchiveError> {
        let mut listing = Listing::default();
        let entries = &self.zip.entries;
        if entries.is_empty() {
            return Err(ArchiveError::Empty);
        }
        for (index, entry) in entries.iter().enumerate() {
            match (normalize_path(&entry.name), entry.kind) {
                (Err(why), _) => listing.errors.push(why),
                (Ok(path), EntryKind::Folder) => listing.folders.push(path),
                (Ok(path), EntryKind::File) => listing.members.push(Member { path, index }),
                (Ok(path), EntryKind::Special) => listing.add_special(&path),
            }
        }
        Ok(listing)
    }

    pub(super) fn read(
        &mut self,
        members: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, ArchiveError> {
        let mut all = Vec::new();
        for member in members {
            // Compressed text is shorter than the text itself, and its headers are short.
            self.budget.reset(2 * longest);
            let mut bytes = Vec::new();
            let entry = self.zip.read(&self.zip.entries[member.index]);
            let entry = entry.map_err(|error| archive_error(&error, &member.path))?;
            let read = entry.take(longest + 1).read_to_end(&mut bytes);
            read.map_err(|error| ArchiveError::Damaged(display_name(&error.to_string())))?;
            all.push(bytes);
        }
        Ok(all)
    }
}

/// Converts an error in a zip file, or in its member with this path.
fn archive_error(error: &ZipError, path: &str) -> ArchiveError {
    match error {
        ZipError::Encrypted => ArchiveError::Encrypted(display_name(path)),
        ZipError::UnsupportedMethod => ArchiveError::UnsupportedCompression(display_name(path)),
        ZipError::TooManyEntries(_) => ArchiveError::TooManyFiles,
        ZipError::Damaged(_) | ZipError::WrongCount => {
            ArchiveError::Damaged(display_name(&error.to_string()))
        }
    }
}
