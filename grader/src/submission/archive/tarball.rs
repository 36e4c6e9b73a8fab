//! `.tar` and `.tar.gz` archives. Unlike zip, tar doesn't contain a central directory, so every
//! access scans the archive from the start.

use std::collections::BTreeMap;
use std::io::{self, Read};

use flate2::read::MultiGzDecoder;
use tar::{Archive, EntryType};

use super::{
    ArchiveBytes, ArchiveError, ArchiveLimits, ByteBudget, LimitedReader, Listing, Member, damaged,
    io_error, normalize_path,
};

/// The offset and the bytes of the magic number in a tar header.
const MAGIC: (usize, &[u8]) = (257, b"ustar");

/// A tar archive, possibly compressed with gzip.
#[derive(Debug)]
pub(super) struct Tarball {
    bytes: ArchiveBytes,
    limits: ArchiveLimits,
}

impl Tarball {
    pub(super) fn open(bytes: ArchiveBytes, limits: ArchiveLimits) -> Result<Self, ArchiveError> {
        let tarball = Tarball { bytes, limits };
        let (reader, _) = tarball.reader()?;
        let mut head = Vec::new();
        let read = reader.take(512).read_to_end(&mut head);
        let (offset, magic) = MAGIC;
        match (read, head.get(offset..offset + magic.len())) {
            (Err(error), _) => Err(damaged(error)),
            (Ok(_), Some(found)) if found == magic => Ok(tarball),
            // An empty tar consists of zeros.
            (Ok(512), _) if head.iter().all(|byte| *byte == 0) => Err(ArchiveError::Empty),
            (Ok(_), _) => Err(ArchiveError::NotAnArchive),
        }
    }

    fn reader(&self) -> Result<(LimitedReader<Box<dyn Read>>, ByteBudget), ArchiveError> {
        let mut magic = [0; 2];
        // A file of fewer than two bytes isn't an archive. It is rejected later, because it has no
        // magic number.
        let _ = self.bytes.reader()?.read(&mut magic).map_err(io_error)?;
        let inner: Box<dyn Read> = match magic {
            [0x1f, 0x8b] => Box::new(MultiGzDecoder::new(self.bytes.reader()?)),
            _ => self.bytes.reader()?,
        };
        let budget = self.limits.total.part(self.limits.tar_bytes);
        Ok((LimitedReader::new(inner, &budget), budget))
    }

    pub(super) fn listing(&mut self) -> Result<Listing, ArchiveError> {
        let mut listing = Listing::default();
        let mut count = 0;
        let most = self.limits.members;
        self.for_each_member(|index, kind, path, entry| {
            count = index + 1;
            if count > most {
                return Err(ArchiveError::TooManyFiles(most));
            }
            match normalize_path(path) {
                Err(why) => listing.errors.push(why),
                Ok(path) if is_link_or_device(kind) => listing.add_special(&path),
                Ok(path) if kind.is_dir() => listing.folders.push(path),
                Ok(path) if kind.is_file() || kind.is_contiguous() || kind.is_gnu_sparse() => {
                    let size = entry.size();
                    listing.members.push(Member { path, size, index });
                }
                // Other entries are metadata, such as the header where Git stores the commit id.
                Ok(_) => {}
            }
            Ok(())
        })?;
        match count {
            0 => Err(ArchiveError::Empty),
            _ => Ok(listing),
        }
    }

    pub(super) fn read_each<E: From<ArchiveError>>(
        &mut self,
        members: &[(&Member, u64)],
        mut each: impl FnMut(usize, Result<Vec<u8>, ArchiveError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let slots = members.iter().enumerate();
        let slots: BTreeMap<usize, (usize, u64)> = slots
            .map(|(slot, (member, longest))| (member.index, (slot, *longest)))
            .collect();
        self.for_each_member(|index, _, _, entry| {
            let Some((slot, longest)) = slots.get(&index) else {
                return Ok(());
            };
            let mut bytes = Vec::new();
            let read = entry.take(longest + 1).read_to_end(&mut bytes);
            read.map_err(damaged)?;
            each(*slot, Ok(bytes))
        })
    }

    /// Calls `each` with the index, kind, recorded path, and content of every member.
    fn for_each_member<E: From<ArchiveError>>(
        &self,
        mut each: impl FnMut(
            usize,
            EntryType,
            &str,
            &mut tar::Entry<'_, LimitedReader<Box<dyn Read>>>,
        ) -> Result<(), E>,
    ) -> Result<(), E> {
        let (reader, budget) = self.reader()?;
        let damaged = |error: io::Error| {
            if budget.is_exhausted() {
                ArchiveError::TooLarge(self.limits.tar_bytes)
            } else {
                damaged(error)
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
