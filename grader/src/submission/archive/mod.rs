//! Reads a submission from an archive, which may be malicious. The archive is read in memory and
//! never unpacked. The sizes and counts in its headers are not trusted: limits apply to the bytes
//! that are actually read and inflated.

mod candidates;
mod limited_reader;
mod tarball;
mod zip_reader;

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use unicode_normalization::UnicodeNormalization;

use super::display_name;
use super::error::is_about_submission;
use crate::disk::{self, Operation};

pub(super) use candidates::candidates;

use limited_reader::LimitedReader;
use tarball::Tarball;
use zip_reader::ZipReader;

/// The maximum number of files in an archive. A checkout with its `target/` has several thousand.
pub const MAX_MEMBERS: usize = 50_000;

/// Reasons for rejecting an archive.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum ArchiveError {
    /// The archive has no bytes, or no members.
    #[error("it is empty: download or submit it again")]
    Empty,
    /// The file is an archive of an unsupported kind.
    #[error(
        "it is a {0} archive, but only .zip, .tar and .tar.gz can be read: pack it as one of these"
    )]
    UnsupportedKind(&'static str),
    /// The file is not an archive.
    #[error("it is neither a folder nor a .zip, .tar or .tar.gz, whatever its name says")]
    NotAnArchive,
    /// The archive is truncated or malformed.
    #[error("it is damaged ({0}): download or pack it again")]
    Damaged(String),
    /// A member is encrypted.
    #[error("the file {0} in it is password-protected: create the archive without a password")]
    Encrypted(String),
    /// A member is compressed with an unsupported method.
    #[error("the file {0} in it is compressed with an unsupported method: create a plain .zip")]
    UnsupportedCompression(String),
    /// Two Rust files have the same path, at least on some file systems.
    #[error("{0} is in it twice, or is the same file as {1} on some systems: pack it again")]
    DuplicatePath(String, String),
    /// There are too many members.
    #[error("it has more than {MAX_MEMBERS} files: pack the task files, without target/")]
    TooManyFiles,
    /// The contents are too large.
    #[error("its contents are larger than {} MiB: pack the task files, without target/", .0 >> 20)]
    TooLarge(u64),
    /// A member's path leads out of the archive.
    #[error("the path {0} in it leads outside the archive: pack it again")]
    PathOutside(String),
    /// A member is a link or a device.
    #[error("{0} in it is a link or device, not a regular file: pack the file itself")]
    NotRegular(String),
    /// The system does not let the file be read.
    #[error("the file cannot be read: {0}")]
    Io(String),
    /// The machine failed to read the file.
    #[error("the file cannot be read: {0}; this is a fault of the machine, so try again")]
    Machine(String),
}

/// A regular file in an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// The path, with `/` and without `.` components. It is relative and stays inside the archive.
    pub path: String,
    /// The index of the file among the members of the archive.
    index: usize,
}

/// The contents of an archive.
#[derive(Debug, Default)]
pub struct Listing {
    /// The regular files in the archive.
    pub members: Vec<Member>,
    /// The paths of the folders in the archive, with `/`.
    pub folders: Vec<String>,
    /// Reasons for rejecting other members.
    pub errors: Vec<ArchiveError>,
}

impl Listing {
    /// Records a link or device: adds an error, and lists its folder. In `target/`, links and
    /// devices are ignored.
    fn add_special(&mut self, path: &str) {
        if let Err(why) = check_special(path) {
            let folder = path.rsplit_once('/').map(|(folder, _)| folder.to_owned());
            self.folders.extend(folder);
            self.errors.push(why);
        }
    }
}

/// An open archive.
#[derive(Debug)]
pub struct Archive(ArchiveReader);

#[derive(Debug)]
enum ArchiveReader {
    Zip(Box<ZipReader>),
    Tar(Tarball),
}

impl Archive {
    /// Opens an archive. Its kind is determined from its first bytes.
    pub fn open(path: &Path) -> Result<Self, ArchiveError> {
        let mut head = Vec::new();
        let file = disk::before(Operation::Read(path)).and_then(|()| File::open(path));
        let file = file.map_err(io_error)?;
        file.take(8).read_to_end(&mut head).map_err(io_error)?;
        Ok(Archive(match head.as_slice() {
            [] => return Err(ArchiveError::Empty),
            [b'P', b'K', 3, 4, ..] | [b'P', b'K', 5, 6, ..] => {
                ArchiveReader::Zip(Box::new(ZipReader::open(path)?))
            }
            [b'R', b'a', b'r', b'!', ..] => return Err(ArchiveError::UnsupportedKind(".rar")),
            [b'7', b'z', 0xbc, 0xaf, ..] => return Err(ArchiveError::UnsupportedKind(".7z")),
            [0xfd, b'7', b'z', b'X', ..] => return Err(ArchiveError::UnsupportedKind(".xz")),
            [b'B', b'Z', b'h', ..] => return Err(ArchiveError::UnsupportedKind(".bz2")),
            [0x28, 0xb5, 0x2f, 0xfd, ..] => return Err(ArchiveError::UnsupportedKind(".zst")),
            [_, ..] => ArchiveReader::Tar(Tarball::open(path)?),
        }))
    }

    /// Lists all contents. A member that is a link or a device, or whose path leads outside, is
    /// only recorded as an error: in the archive of a whole class, it affects only one student.
    pub fn listing(&mut self) -> Result<Listing, ArchiveError> {
        let mut listing = match &mut self.0 {
            ArchiveReader::Zip(zip) => zip.listing(),
            ArchiveReader::Tar(tar) => tar.listing(),
        }?;
        let duplicates = duplicate_paths(&listing.members);
        listing.errors.extend(duplicates);
        Ok(listing)
    }

    /// Lists the regular files. Fails if any member is rejected.
    pub fn members(&mut self) -> Result<Vec<Member>, ArchiveError> {
        let listing = self.listing()?;
        match listing.errors.into_iter().next() {
            Some(why) => Err(why),
            None => Ok(listing.members),
        }
    }

    /// Returns the contents of these members, in the same order. If a member has more than
    /// `longest` bytes, only the first `longest + 1` are returned.
    pub fn read(
        &mut self,
        members: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, ArchiveError> {
        match &mut self.0 {
            ArchiveReader::Zip(zip) => zip.read(members, longest),
            ArchiveReader::Tar(tar) => tar.read(members, longest),
        }
    }

    /// Returns the number of members that should be read in one call. A tar is scanned from the
    /// start on each call, so all its members should be read at once.
    pub fn batch_size(&self) -> usize {
        match &self.0 {
            ArchiveReader::Zip(_) => 1,
            ArchiveReader::Tar(_) => MAX_MEMBERS,
        }
    }
}

/// Returns whether this is the name of an archive, even if its kind is not supported.
pub fn is_archive_name(name: &str) -> bool {
    const ENDINGS: [&str; 12] = [
        ".zip", ".tar", ".tar.gz", ".tgz", ".rar", ".7z", ".tar.xz", ".txz", ".tar.bz2",
        ".tar.zst", ".gz", ".xz",
    ];
    let lower = name.to_lowercase();
    ENDINGS.iter().any(|ending| lower.ends_with(ending))
}

/// Returns the archive's name without its extension.
pub(super) fn without_extension(file: &str) -> String {
    let endings = [".tar.gz", ".tgz", ".tar", ".zip"];
    let lower = file.to_ascii_lowercase();
    let ending = endings.iter().find(|ending| lower.ends_with(**ending));
    let length = file.len() - ending.map_or(0, |ending| ending.len());
    match &file[..length] {
        "" => file.to_owned(),
        stem => stem.to_owned(),
    }
}

/// Returns a member's path with `/` and without `.` components. Fails if it leads outside.
fn normalize_path(path: &str) -> Result<String, ArchiveError> {
    // Some programs on Windows write `\`, against the standard.
    let path = path.replace('\\', "/");
    let is_absolute = path.starts_with('/') || path.get(1..2) == Some(":");
    if is_absolute || path.split('/').any(|part| part == "..") {
        return Err(ArchiveError::PathOutside(display_name(&path)));
    }
    let parts = path
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".");
    Ok(parts.collect::<Vec<_>>().join("/"))
}

/// Returns an error for each Rust file with the same path as an earlier one. Which of the two files
/// is used would depend on the program that unpacks the archive.
fn duplicate_paths(members: &[Member]) -> Vec<ArchiveError> {
    let mut known: BTreeMap<String, &str> = BTreeMap::new();
    let mut errors = Vec::new();
    for member in members {
        let folded = folded_path(&member.path);
        if !folded.ends_with(".rs") {
            continue;
        }
        if let Some(first) = known.insert(folded, &member.path) {
            let (path, first) = (display_name(&member.path), display_name(first));
            errors.push(ArchiveError::DuplicatePath(path, first));
        }
    }
    errors
}

/// Normalises a path for comparison: two paths become equal if any common file system treats them
/// as the same. The result is in lower case (macOS, Windows) and in Unicode's composed form, NFC
/// (macOS), and its names have no trailing dots or spaces (Windows).
fn folded_path(path: &str) -> String {
    let folded: String = path.to_lowercase().nfc().collect();
    let names = folded
        .split('/')
        .map(|name| name.trim_end_matches(['.', ' ']));
    names.collect::<Vec<_>>().join("/")
}

/// Rejects a link or device, except in `target/`: Cargo makes hard links there, and nothing in it
/// is read.
fn check_special(path: &str) -> Result<(), ArchiveError> {
    if path.split('/').any(|part| part == "target") {
        Ok(())
    } else {
        Err(ArchiveError::NotRegular(display_name(path)))
    }
}

fn io_error(error: io::Error) -> ArchiveError {
    let why = error.kind().to_string();
    if is_about_submission(&error) {
        ArchiveError::Io(why)
    } else {
        ArchiveError::Machine(why)
    }
}

#[cfg(test)]
mod tests;
