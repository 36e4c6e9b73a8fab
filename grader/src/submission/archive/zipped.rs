//! `.zip`: the directory at its end says what is in it, and only what is wanted is inflated.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use zip::ZipArchive;
use zip::result::ZipError;

use super::stream::Allowance;
use super::{Listing, MOST_MEMBERS, Member, Refused, Stream, io, shown, tidy};

/// How much may be read to learn what is in it: the directory of some 50,000 members.
const LONGEST_DIRECTORY: u64 = 8 << 20;

/// What kind of thing a Unix mode speaks of.
const KIND: u32 = 0o170_000;
const REGULAR: u32 = 0o100_000;

/// A zip, its directory read.
#[derive(Debug)]
pub(super) struct Zipped {
    archive: ZipArchive<Stream<BufReader<File>>>,
    allowance: Allowance,
}

impl Zipped {
    pub(super) fn open(path: &Path) -> Result<Self, Refused> {
        let file = BufReader::new(File::open(path).map_err(io)?);
        let (stream, allowance) = Stream::new(file, LONGEST_DIRECTORY);
        let archive = ZipArchive::new(stream).map_err(|error| match allowance.is_used_up() {
            true => Refused::TooMany,
            false => damaged(&error),
        })?;
        Ok(Zipped { archive, allowance })
    }

    pub(super) fn listing(&mut self) -> Result<Listing, Refused> {
        let mut listing = Listing::default();
        match self.archive.len() {
            0 => return Err(Refused::Empty),
            count if count > MOST_MEMBERS => return Err(Refused::TooMany),
            _ if self.archive.has_duplicate_names() => listing.refused.push(Refused::Twice),
            _ => {}
        }
        for place in 0..self.archive.len() {
            let entry = self.archive.by_index_data(place);
            let entry = entry.map_err(|error| damaged(&error))?;
            let name = match entry.name() {
                Ok(name) => name.into_owned(),
                Err(_) => String::from_utf8_lossy(entry.name_raw()).into_owned(),
            };
            let kind = entry.unix_mode().map_or(0, |mode| mode & KIND);
            match (tidy(&name), kind) {
                (Err(why), _) => listing.refused.push(why),
                (Ok(path), _) if entry.is_dir() => listing.folders.push(path),
                (Ok(path), 0 | REGULAR) => listing.members.push(Member { path, place }),
                (Ok(path), _) => listing.special(&path),
            }
        }
        Ok(listing)
    }

    pub(super) fn read(
        &mut self,
        members: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, Refused> {
        let mut all = Vec::new();
        for member in members {
            // Packed, an honest text is shorter than it is, and its headers are short.
            self.allowance.renew(2 * longest);
            let mut bytes = Vec::new();
            let entry = self.archive.by_index(member.place);
            let entry = entry.map_err(|error| refused(&error, &member.path))?;
            let read = entry.take(longest + 1).read_to_end(&mut bytes);
            read.map_err(|error| Refused::Damaged(error.to_string()))?;
            all.push(bytes);
        }
        Ok(all)
    }
}

fn refused(error: &ZipError, path: &str) -> Refused {
    match error {
        ZipError::UnsupportedArchive(why) if *why == ZipError::PASSWORD_REQUIRED => {
            Refused::Encrypted(shown(path))
        }
        ZipError::CompressionMethodNotSupported(_) | ZipError::UnsupportedArchive(_) => {
            Refused::Method(shown(path))
        }
        ZipError::Io(_)
        | ZipError::InvalidArchive(_)
        | ZipError::FileNotFound
        | ZipError::InvalidPassword
        | ZipError::DecompressedSizeLimitExceeded { .. }
        | ZipError::DecompressedSizeUnknown
        // The crate may tell more one day.
        | _ => damaged(error),
    }
}

fn damaged(error: &ZipError) -> Refused {
    Refused::Damaged(shown(&error.to_string()))
}
