//! Reads a submission from an archive, which may be malicious. The archive is read in memory and
//! never unpacked. The sizes and counts in its headers aren't trusted. Limits apply to the bytes
//! that are actually read and inflated.

mod paths;
mod search;
mod tarball;
mod zip_reader;

use std::fmt;
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use rawzip::{FileReader, ReaderAt};

use super::display_name;
use super::limited_reader::{ByteBudget, LimitedReader};
use crate::machine::disk::{self, Operation};
use crate::machine::files::is_about_file;

pub(super) use search::search;

use paths::{check_special, duplicate_paths, normalize_path};
use tarball::Tarball;
use zip_reader::ZipReader;

/// The maximum number of levels of nested archives to open.
const MAX_LEVELS: usize = 3;

/// The limits on reading from an archive.
#[derive(Clone, Debug)]
pub struct ArchiveLimits {
    /// The maximum number of members. A checkout with its `target/` has several thousand.
    members: usize,
    /// The maximum size of an uncompressed tar in bytes, including members that are skipped.
    tar_bytes: u64,
    /// The number of bytes, compressed and inflated, that may still be read from this archive and
    /// others.
    total: ByteBudget,
}

impl ArchiveLimits {
    /// Returns the limits for an archive that contains one submission.
    pub(super) fn submission(total: &ByteBudget) -> Self {
        ArchiveLimits {
            members: 50_000,
            tar_bytes: 256 << 20,
            total: total.clone(),
        }
    }

    /// Returns the limits for the archive of a whole class. These are so large that a single
    /// submission in the archive is unlikely to reach them.
    pub fn class() -> Self {
        ArchiveLimits {
            members: 2_000_000,
            tar_bytes: 64 << 30,
            total: ByteBudget::new(u64::MAX),
        }
    }
}

/// Reasons for rejecting an archive.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum ArchiveError {
    /// The archive is empty, or contains no members.
    #[error("it is empty: download or submit it again")]
    Empty,
    /// The file is an archive of an unsupported kind.
    #[error(
        "it is a {0} archive, but only .zip, .tar and .tar.gz can be read: repack it in one of these formats"
    )]
    UnsupportedKind(&'static str),
    /// The file isn't an archive.
    #[error(
        "it is neither a folder nor a valid .zip, .tar or .tar.gz: pack the files again in one of these formats"
    )]
    NotAnArchive,
    /// The archive is truncated or malformed.
    #[error("it is damaged ({0}): download or pack it again")]
    Damaged(String),
    /// A member is encrypted.
    #[error("it contains a password-protected file, {0}: create the archive without a password")]
    Encrypted(String),
    /// A member is compressed with an unsupported method.
    #[error(
        "it contains the file {0}, which is compressed with an unsupported method: create a plain .zip"
    )]
    UnsupportedCompression(String),
    /// The paths of two Rust files are the same on at least some file systems.
    #[error(
        "it contains {0} and {1}, which some systems treat as the same file: pack it again with only one of them"
    )]
    DuplicatePath(String, String),
    /// The archive contains too many members.
    #[error("it has more than {0} files: pack only the task files, without target/")]
    TooManyFiles(usize),
    /// The contents are too large.
    #[error("its contents are larger than {} MiB: pack only the task files, without target/", .0 >> 20)]
    TooLarge(u64),
    /// The archive is nested too deeply.
    #[error("it is nested inside {MAX_LEVELS} other archives, so it was not opened: unpack them")]
    TooDeep,
    /// A member's path leads out of the archive.
    #[error("it contains the path {0}, which leads outside the archive: pack it again")]
    PathOutside(String),
    /// A member is a link or a device.
    #[error("it contains {0}, which is a link or device, not a regular file: pack the file itself")]
    NotRegular(String),
    /// The system doesn't allow the file to be read.
    #[error("the file cannot be read: {0}")]
    Io(String),
    /// The machine failed to read the file.
    #[error("the file cannot be read: {0}; this is a problem with the machine, so try again")]
    Machine(String),
}

/// A regular file in an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// The path, with `/` as the separator and without `.` components. It is relative and stays
    /// inside the archive.
    pub path: String,
    /// The size declared in the archive, in bytes.
    pub size: u64,
    /// The index of the file among the archive's members.
    index: usize,
}

/// The contents of an archive.
#[derive(Debug, Default)]
pub struct Listing {
    /// The regular files in the archive.
    pub members: Vec<Member>,
    /// The paths of the folders in the archive, with `/` as the separator.
    pub folders: Vec<String>,
    /// Reasons for rejecting other members.
    pub errors: Vec<ArchiveError>,
}

impl Listing {
    /// Records a link or device: adds an error and lists its folder. Links and devices in `target/`
    /// are ignored.
    fn add_special(&mut self, path: &str) {
        if let Err(why) = check_special(path) {
            let folder = path.rsplit_once('/').map(|(folder, _)| folder.to_owned());
            self.folders.extend(folder);
            self.errors.push(why);
        }
    }
}

/// The location of an archive's bytes.
#[derive(Clone, Debug)]
pub(super) enum ArchiveBytes {
    /// A file on disk.
    File(PathBuf),
    /// A member of another archive.
    Member(Rc<[u8]>),
}

impl ArchiveBytes {
    fn reader(&self) -> Result<Box<dyn Read>, ArchiveError> {
        Ok(match self {
            ArchiveBytes::File(path) => {
                Box::new(BufReader::new(File::open(path).map_err(io_error)?))
            }
            ArchiveBytes::Member(bytes) => Box::new(Cursor::new(Rc::clone(bytes))),
        })
    }

    /// Returns a reader for the bytes, and the number of bytes.
    fn reader_at(&self) -> Result<(Box<dyn ReaderAt>, u64), ArchiveError> {
        Ok(match self {
            ArchiveBytes::File(path) => {
                let file = File::open(path).map_err(io_error)?;
                let length = file.metadata().map_err(io_error)?.len();
                (Box::new(FileReader::from(file)), length)
            }
            ArchiveBytes::Member(bytes) => {
                (Box::new(Cursor::new(Rc::clone(bytes))), bytes.len() as u64)
            }
        })
    }
}

/// An open archive.
pub struct Archive(ArchiveReader);

enum ArchiveReader {
    Zip(Box<ZipReader>),
    Tar(Tarball),
}

impl fmt::Debug for Archive {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("Archive")
    }
}

impl Archive {
    /// Opens an archive on disk.
    pub fn open(path: &Path, limits: ArchiveLimits) -> Result<Self, ArchiveError> {
        disk::before(Operation::Read(path)).map_err(io_error)?;
        Archive::open_bytes(ArchiveBytes::File(path.to_owned()), limits)
    }

    /// Opens an archive. Its kind is determined from its first bytes.
    fn open_bytes(bytes: ArchiveBytes, limits: ArchiveLimits) -> Result<Self, ArchiveError> {
        let mut head = Vec::new();
        let read = bytes.reader()?.take(8).read_to_end(&mut head);
        read.map_err(io_error)?;
        Ok(Archive(match head.as_slice() {
            [] => return Err(ArchiveError::Empty),
            [b'P', b'K', 3, 4, ..] | [b'P', b'K', 5, 6, ..] => {
                ArchiveReader::Zip(Box::new(ZipReader::open(&bytes, &limits)?))
            }
            [b'R', b'a', b'r', b'!', ..] => return Err(ArchiveError::UnsupportedKind(".rar")),
            [b'7', b'z', 0xbc, 0xaf, ..] => return Err(ArchiveError::UnsupportedKind(".7z")),
            [0xfd, b'7', b'z', b'X', ..] => return Err(ArchiveError::UnsupportedKind(".xz")),
            [b'B', b'Z', b'h', ..] => return Err(ArchiveError::UnsupportedKind(".bz2")),
            [0x28, 0xb5, 0x2f, 0xfd, ..] => return Err(ArchiveError::UnsupportedKind(".zst")),
            [_, ..] => ArchiveReader::Tar(Tarball::open(bytes, limits)?),
        }))
    }

    /// Lists all contents. A member that is a link or a device, or whose path leads outside, is
    /// only recorded as an error, because in a whole class's archive it only affects one student.
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

    /// Returns these members' contents in the same order. If a member has more than `longest`
    /// bytes, only the first `longest + 1` are returned.
    pub fn read(
        &mut self,
        members: &[&Member],
        longest: u64,
    ) -> Result<Vec<Vec<u8>>, ArchiveError> {
        let members: Vec<_> = members.iter().map(|member| (*member, longest)).collect();
        let mut all = vec![Vec::new(); members.len()];
        self.read_each(&members, |slot, bytes| {
            all[slot] = bytes?;
            Ok::<_, ArchiveError>(())
        })?;
        Ok(all)
    }

    /// Calls `each` with the index and the contents of each of these members. Only one member is in
    /// memory at a time. If a member has more bytes than requested, one byte more than requested is
    /// read. A tar is scanned once. In a zip, a damaged member doesn't affect the others.
    pub fn read_each<E: From<ArchiveError>>(
        &mut self,
        members: &[(&Member, u64)],
        mut each: impl FnMut(usize, Result<Vec<u8>, ArchiveError>) -> Result<(), E>,
    ) -> Result<(), E> {
        match &mut self.0 {
            ArchiveReader::Zip(zip) => {
                let mut members = members.iter().enumerate();
                members.try_for_each(|(slot, (member, longest))| {
                    each(slot, zip.read(member, *longest))
                })
            }
            ArchiveReader::Tar(tar) => tar.read_each(members, each),
        }
    }
}

fn damaged(error: impl fmt::Display) -> ArchiveError {
    ArchiveError::Damaged(display_name(&error.to_string()))
}

fn io_error(error: io::Error) -> ArchiveError {
    let why = error.kind().to_string();
    if is_about_file(&error) {
        ArchiveError::Io(why)
    } else {
        ArchiveError::Machine(why)
    }
}

#[cfg(test)]
mod tests;
