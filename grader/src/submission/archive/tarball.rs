//! `.tar` and `.tar.gz`: read from the front, as often as needed.

use std::fs::File;
use std::io::{self as system, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;
use tar::{Archive, EntryType};

use super::stream::Allowance;
use super::{Listing, MOST_MEMBERS, Member, Refused, Stream, io, shown, tidy};

/// How much may come out of it, wanted or not, in bytes.
const MOST: u64 = 256 << 20;
/// Where a header says that it is one, and with what.
const MAGIC: (usize, &[u8]) = (257, b"ustar");

/// A tar, perhaps in gzip.
#[derive(Debug)]
pub(super) struct Tarball {
    path: PathBuf,
}

impl Tarball {
    pub(super) fn open(path: &Path) -> Result<Self, Refused> {
        let tarball = Tarball {
            path: path.to_owned(),
        };
        let (stream, _) = tarball.stream()?;
        let mut head = Vec::new();
        let read = stream.take(512).read_to_end(&mut head);
        let (place, magic) = MAGIC;
        match (read, head.get(place..place + magic.len())) {
            (Err(error), _) => Err(Refused::Damaged(shown(&error.to_string()))),
            (Ok(_), Some(found)) if found == magic => Ok(tarball),
            // So does a tar of nothing look.
            (Ok(512), _) if head.iter().all(|byte| *byte == 0) => Err(Refused::Empty),
            (Ok(_), _) => Err(Refused::NotAnArchive),
        }
    }

    fn stream(&self) -> Result<(Stream<Box<dyn Read>>, Allowance), Refused> {
        let file = || File::open(&self.path).map(BufReader::new).map_err(io);
        let mut magic = [0; 2];
        // A shorter file is no archive, which its magic number will tell.
        let _ = file()?.read(&mut magic).map_err(io)?;
        let inner: Box<dyn Read> = match magic {
            [0x1f, 0x8b] => Box::new(MultiGzDecoder::new(file()?)),
            _ => Box::new(file()?),
        };
        Ok(Stream::new(inner, MOST))
    }

    pub(super) fn listing(&mut self) -> Result<Listing, Refused> {
        let mut listing = Listing::default();
        let mut count = 0;
        self.walk(|place, kind, path, _| {
            count = place + 1;
            if count > MOST_MEMBERS {
                return Err(Refused::TooMany);
            }
            match tidy(path) {
                Err(why) => listing.refused.push(why),
                Ok(path) if is_link_or_device(kind) => listing.special(&path),
                Ok(path) if kind.is_dir() => listing.folders.push(path),
                Ok(path) if kind.is_file() || kind.is_contiguous() || kind.is_gnu_sparse() => {
                    listing.members.push(Member { path, place });
                }
                // What headers say of all files, such as Git's commit.
                Ok(_) => {}
            }
            Ok(())
        })?;
        match count {
            0 => Err(Refused::Empty),
            _ => Ok(listing),
        }
    }

    pub(super) fn read(
        &mut self,
        wanted: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, Refused> {
        let mut all = vec![Vec::new(); wanted.len()];
        self.walk(|place, _, _, entry| {
            let slot = wanted.iter().position(|member| member.place == place);
            if let Some(slot) = slot {
                let read = entry.take(longest + 1).read_to_end(&mut all[slot]);
                read.map_err(|error| Refused::Damaged(shown(&error.to_string())))?;
            }
            Ok(())
        })?;
        Ok(all)
    }

    /// Calls `each` with every member: place, kind, path as it stands there, and content.
    fn walk(
        &self,
        mut each: impl FnMut(usize, EntryType, &str, &mut dyn Read) -> Result<(), Refused>,
    ) -> Result<(), Refused> {
        let (stream, allowance) = self.stream()?;
        let damaged = |error: system::Error| match allowance.is_used_up() {
            true => Refused::TooMuch(MOST),
            false => Refused::Damaged(shown(&error.to_string())),
        };
        let mut archive = Archive::new(stream);
        for (place, entry) in archive.entries().map_err(damaged)?.enumerate() {
            let mut entry = entry.map_err(damaged)?;
            let path = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
            let kind = entry.header().entry_type();
            each(place, kind, &path, &mut entry)?;
        }
        Ok(())
    }
}

fn is_link_or_device(kind: EntryType) -> bool {
    let is_link = kind.is_symlink() || kind.is_hard_link();
    is_link || kind.is_character_special() || kind.is_block_special() || kind.is_fifo()
}
