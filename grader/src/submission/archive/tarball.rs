//! `.tar` and `.tar.gz` archives. Unlike zip, tar has no central directory, so every access scans
//! the archive from the start.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;
use tar::{Archive, EntryType};

use super::limited_reader::ByteBudget;
use super::{
    ArchiveError, LimitedReader, Listing, MAX_MEMBERS, Member, display_name, io_error,
    normalize_path,
};

/// The maximum size of an uncompressed tar in bytes, including members that are skipped.
const MAX_BYTES: u64 = 256 << 20;
/// The offset and the bytes of the magic number in a tar header.
const MAGIC: (usize, &[u8]) = (257, b"ustar");

/// A tar archive, possibly compressed with gzip.
#[derive(Debug)]
pub(super) struct Tarball {
    path: PathBuf,
}

impl Tarball {
    pub(super) fn open(path: &Path) -> Result<Self, ArchiveError> {
        let tarball = Tarball {
            path: path.to_owned(),
        };
        let (reader, _) = tarball.reader()?;
        let mut head = Vec::new();
        let read = reader.take(512).read_to_end(&mut head);
        let (offset, magic) = MAGIC;
        match (read, head.get(offset..offset + magic.len())) {
            (Err(error), _) => Err(ArchiveError::Damaged(display_name(&error.to_string()))),
            (Ok(_), Some(found)) if found == magic => Ok(tarball),
            // An empty tar consists of zeros.
            (Ok(512), _) if head.iter().all(|byte| *byte == 0) => Err(ArchiveError::Empty),
            (Ok(_), _) => Err(ArchiveError::NotAnArchive),
        }
    }

    fn reader(&self) -> Result<(LimitedReader<Box<dyn Read>>, ByteBudget), ArchiveError> {
        let file = || File::open(&self.path).map(BufReader::new).map_err(io_error);
        let mut magic = [0; 2];
        // A file of fewer than two bytes is not an archive. It is rejected later, because it has no
        // magic number.
        let _ = file()?.read(&mut magic).map_err(io_error)?;
        let inner: Box<dyn Read> = match magic {
            [0x1f, 0x8b] => Box::new(MultiGzDecoder::new(file()?)),
            _ => Box::new(file()?),
        };
        Ok(LimitedReader::new(inner, MAX_BYTES))
    }

    pub(super) fn listing(&mut self) -> Result<Listing, ArchiveError> {
        let mut listing = Listing::default();
        let mut count = 0;
        self.for_each_member(|index, kind, path, _| {
            count = index + 1;
            if count > MAX_MEMBERS {
                return Err(ArchiveError::TooManyFiles);
            }
            match normalize_path(path) {
                Err(why) => listing.errors.push(why),
                Ok(path) if is_link_or_device(kind) => listing.add_special(&path),
                Ok(path) if kind.is_dir() => listing.folders.push(path),
                Ok(path) if kind.is_file() || kind.is_contiguous() || kind.is_gnu_sparse() => {
                    listing.members.push(Member { path, index });
                }
                // Other entries are metadata, such as the header in which Git stores the commit id.
                Ok(_) => {}
            }
            Ok(())
        })?;
        match count {
            0 => Err(ArchiveError::Empty),
            _ => Ok(listing),
        }
    }

    pub(super) fn read(
        &mut self,
        members: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, ArchiveError> {
        let mut all = vec![Vec::new(); members.len()];
        self.for_each_member(|index, _, _, entry| {
            let slot = members.iter().position(|member| member.index == index);
            if let Some(slot) = slot {
                let read = entry.take(longest + 1).read_to_end(&mut all[slot]);
                read.map_err(|error| ArchiveError::Damaged(display_name(&error.to_string())))?;
            }
            Ok(())
        })?;
        Ok(all)
    }

    /// Calls `each` with the index, kind, recorded path, and content of every member.
    fn for_each_member(
        &self,
        mut each: impl FnMut(usize, EntryType, &str, &mut dyn Read) -> Result<(), ArchiveError>,
    ) -> Result<(), ArchiveError> {
        let (reader, budget) = self.reader()?;
        let damaged = |error: io::Error| {
            if budget.is_exhausted() {
                ArchiveError::TooLarge(MAX_BYTES)
            } else {
                ArchiveError::Damaged(display_name(&error.to_string()))
            }
        };
        let mut archive = Archive::new(reader);
        for (index, entry) in archive.entries().map_err(damaged)?.enumerate() {
            let mut entry = entry.map_err(damaged)?;
            let path = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
            let kind = entry.header().entry_type();
            each(index, kind, &path, &mut entry)?;
        }
        Ok(())
    }
}

fn is_link_or_device(kind: EntryType) -> bool {
    let is_link = kind.is_symlink() || kind.is_hard_link();
    is_link || kind.is_character_special() || kind.is_block_special() || kind.is_fifo()
}
