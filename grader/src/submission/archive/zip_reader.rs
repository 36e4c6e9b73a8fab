//! `.zip` archives. The central directory at the end lists the contents, and only requested members
//! are inflated.

use std::io::Read;

use rawzip::ReaderAt;

use crate::machine::zipfile::{EntryKind, Zip, ZipError};

use super::{
    ArchiveBytes, ArchiveError, ArchiveLimits, ByteBudget, LimitedReader, Listing, Member, damaged,
    display_name, normalize_path,
};

/// The maximum number of bytes to read per member when listing the contents. This is roughly the
/// size of a member's entry in the central directory.
const DIRECTORY_BYTES: u64 = 168;

/// The maximum number of bytes to read for the headers of a member.
const HEADER_BYTES: u64 = 1 << 20;

/// A zip archive whose central directory has been read.
pub(super) struct ZipReader {
    zip: Zip<LimitedReader<Box<dyn ReaderAt>>>,
    budget: ByteBudget,
}

impl ZipReader {
    pub(super) fn open(bytes: &ArchiveBytes, limits: &ArchiveLimits) -> Result<Self, ArchiveError> {
        let (reader, length) = bytes.reader_at()?;
        let budget = limits.total.part(DIRECTORY_BYTES * limits.members as u64);
        let reader = LimitedReader::new(reader, &budget);
        let zip = Zip::open(reader, length, limits.members).map_err(|error| {
            if budget.is_exhausted() {
                ArchiveError::TooManyFiles(limits.members)
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
            let size = entry.size;
            match (normalize_path(&entry.name), entry.kind) {
                (Err(why), _) => listing.errors.push(why),
                (Ok(path), EntryKind::Folder) => listing.folders.push(path),
                (Ok(path), EntryKind::File) => listing.members.push(Member { path, size, index }),
                (Ok(path), EntryKind::Special) => listing.add_special(&path),
            }
        }
        Ok(listing)
    }

    pub(super) fn read(&self, member: &Member, longest: u64) -> Result<Vec<u8>, ArchiveError> {
        // Compressed text is at most slightly longer than the text itself.
        self.budget.reset(2 * longest + HEADER_BYTES);
        let mut bytes = Vec::new();
        let entry = self.zip.read(&self.zip.entries[member.index]);
        let entry = entry.map_err(|error| archive_error(&error, &member.path))?;
        let read = entry.take(longest + 1).read_to_end(&mut bytes);
        self.budget.spend(bytes.len() as u64);
        read.map_err(damaged)?;
        Ok(bytes)
    }
}

/// Converts an error about a zip file, or about the member at `path`.
fn archive_error(error: &ZipError, path: &str) -> ArchiveError {
    match error {
        ZipError::Encrypted => ArchiveError::Encrypted(display_name(path)),
        ZipError::UnsupportedMethod => ArchiveError::UnsupportedCompression(display_name(path)),
        ZipError::TooManyEntries(most) => ArchiveError::TooManyFiles(*most),
        ZipError::Damaged(_) | ZipError::WrongCount => damaged(error),
    }
}
