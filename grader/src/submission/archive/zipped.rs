//! `.zip`: the directory at its end says what is in it, and only what is wanted is inflated.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use rawzip::FileReader;

use crate::zipfile::{BadZip, Kind, Zip};

use super::stream::Allowance;
use super::{Listing, MOST_MEMBERS, Member, Refused, Stream, io, shown, tidy};

/// How much may be read to learn what is in it: the directory of some 50,000 members.
const LONGEST_DIRECTORY: u64 = 8 << 20;

/// A zip, its directory read.
#[derive(Debug)]
pub(super) struct Zipped {
    zip: Zip<Stream<FileReader>>,
    allowance: Allowance,
}

impl Zipped {
    pub(super) fn open(path: &Path) -> Result<Self, Refused> {
        let file = File::open(path).map_err(io)?;
        let length = file.metadata().map_err(io)?.len();
        let (stream, allowance) = Stream::new(FileReader::from(file), LONGEST_DIRECTORY);
        let zip = Zip::open(stream, length, MOST_MEMBERS).map_err(|bad| {
            match allowance.is_used_up() {
                true => Refused::TooMany,
                false => refused(&bad, ""),
            }
        })?;
        Ok(Zipped { zip, allowance })
    }

    pub(super) fn listing(&mut self) -> Result<Listing, Refused> {
        let mut listing = Listing::default();
        let entries = &self.zip.entries;
        let names: BTreeSet<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        match entries.len() {
            0 => return Err(Refused::Empty),
            count if count > names.len() => listing.refused.push(Refused::Twice),
            _ => {}
        }
        for (place, entry) in entries.iter().enumerate() {
            match (tidy(&entry.name), entry.kind) {
                (Err(why), _) => listing.refused.push(why),
                (Ok(path), Kind::Folder) => listing.folders.push(path),
                (Ok(path), Kind::File) => listing.members.push(Member { path, place }),
                (Ok(path), Kind::Special) => listing.special(&path),
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
            let entry = self.zip.read(&self.zip.entries[member.place]);
            let entry = entry.map_err(|bad| refused(&bad, &member.path))?;
            let read = entry.take(longest + 1).read_to_end(&mut bytes);
            read.map_err(|error| Refused::Damaged(shown(&error.to_string())))?;
            all.push(bytes);
        }
        Ok(all)
    }
}

/// What is said of a zip, or of the file in it that has this path.
fn refused(bad: &BadZip, path: &str) -> Refused {
    match bad {
        BadZip::Encrypted => Refused::Encrypted(shown(path)),
        BadZip::Method => Refused::Method(shown(path)),
        BadZip::TooMany(_) => Refused::TooMany,
        BadZip::Damaged(_) | BadZip::Count => Refused::Damaged(shown(&bad.to_string())),
    }
}
