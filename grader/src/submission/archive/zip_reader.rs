//! `.zip`: the directory at its end says what is in it, and only what is wanted is inflated.

use std::collections::BTreeSet;
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

/// How much may be read to learn what is in it: the directory of some 50,000 members.
const MAX_DIRECTORY_BYTES: u64 = 8 << 20;

/// A zip, its directory read.
#[derive(Debug)]
pub(super) struct ZipReader {
    zip: Zip<LimitedReader<FileReader>>,
    budget: ByteBudget,
}

impl ZipReader {
    pub(super) fn open(path: &Path) -> Result<Self, ArchiveError> {
        let file = File::open(path).map_err(io_error)?;
        let length = file.metadata().map_err(io_error)?.len();
        let (stream, allowance) = LimitedReader::new(FileReader::from(file), MAX_DIRECTORY_BYTES);
        let zip = Zip::open(stream, length, MAX_MEMBERS).map_err(|bad| {
            match allowance.is_exhausted() {
                true => ArchiveError::TooManyFiles,
                false => archive_error(&bad, ""),
            }
        })?;
        Ok(ZipReader {
            zip,
            budget: allowance,
        })
    }

    pub(super) fn listing(&mut self) -> Result<Listing, ArchiveError> {
        let mut listing = Listing::default();
        let entries = &self.zip.entries;
        let names: BTreeSet<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        match entries.len() {
            0 => return Err(ArchiveError::Empty),
            count if count > names.len() => listing.errors.push(ArchiveError::DuplicateName),
            _ => {}
        }
        for (place, entry) in entries.iter().enumerate() {
            match (normalize_path(&entry.name), entry.kind) {
                (Err(why), _) => listing.errors.push(why),
                (Ok(path), EntryKind::Folder) => listing.folders.push(path),
                (Ok(path), EntryKind::File) => listing.members.push(Member { path, index: place }),
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
            // Packed, an honest text is shorter than it is, and its headers are short.
            self.budget.reset(2 * longest);
            let mut bytes = Vec::new();
            let entry = self.zip.read(&self.zip.entries[member.index]);
            let entry = entry.map_err(|bad| archive_error(&bad, &member.path))?;
            let read = entry.take(longest + 1).read_to_end(&mut bytes);
            read.map_err(|error| ArchiveError::Damaged(display_name(&error.to_string())))?;
            all.push(bytes);
        }
        Ok(all)
    }
}

/// What is said of a zip, or of the file in it that has this path.
fn archive_error(bad: &ZipError, path: &str) -> ArchiveError {
    match bad {
        ZipError::Encrypted => ArchiveError::Encrypted(display_name(path)),
        ZipError::UnsupportedMethod => ArchiveError::UnsupportedCompression(display_name(path)),
        ZipError::TooManyEntries(_) => ArchiveError::TooManyFiles,
        ZipError::Damaged(_) | ZipError::WrongCount => {
            ArchiveError::Damaged(display_name(&bad.to_string()))
        }
    }
}
