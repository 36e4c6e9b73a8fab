//! From archives, which anybody may have made: read in memory and never unpacked. What a header
//! claims of sizes and counts is not believed; what is really read and inflated is counted.

mod limited_reader;
mod tarball;
mod zip_reader;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::source_folder::{self, AmbiguousSource};
use super::{
    MAX_FILE_BYTES, SubmissionError, SubmissionFiles, TaskFileError, display_name, is_given_file,
    task_file_name,
};

use limited_reader::LimitedReader;
use tarball::Tarball;
use zip_reader::ZipReader;

/// The most files that an archive may hold. A checkout with its `target/` has some thousands.
pub const MAX_MEMBERS: usize = 50_000;

/// Why an archive is not read.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum ArchiveError {
    /// It has no bytes, or no members.
    #[error("it is empty: hand it in, or download it, again")]
    Empty,
    /// It is an archive of another kind.
    #[error("it is a {0} archive: only .zip, .tar and .tar.gz are read, so pack it as one of them")]
    UnsupportedKind(&'static str),
    /// It is anything else.
    #[error("it is neither a folder nor a .zip, .tar or .tar.gz, whatever its name says")]
    NotAnArchive,
    /// It ends too soon, or is not what it claims to be.
    #[error("it is damaged ({0}): download or pack it again")]
    Damaged(String),
    /// It is encrypted.
    #[error("{0} in it needs a password: pack it without one")]
    Encrypted(String),
    /// It is compressed in an unusual way.
    #[error("{0} in it is compressed in a way of its own: pack it as a plain .zip")]
    UnsupportedCompression(String),
    /// Two members have the same name.
    #[error("two files in it have the same name: pack it again")]
    DuplicateName,
    /// There are too many members.
    #[error("it holds more than {MAX_MEMBERS} files: pack the five files, without target/")]
    TooManyFiles,
    /// There is too much in it.
    #[error("it holds more than {} MiB: pack the five files, without target/", .0 >> 20)]
    TooLarge(u64),
    /// A member's path leads out of the archive.
    #[error("{0} in it is a path that leads out of it: pack it again")]
    PathOutside(String),
    /// A member is a link or a device.
    #[error("{0} in it is no regular file but a link or device: pack the file itself")]
    NotRegular(String),
    /// The system does not let us read it.
    #[error("it can not be read: {0}")]
    Io(String),
}

/// One file of an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// With `/`, without `.`: never absolute, never leading outside.
    pub path: String,
    /// Where it stands in the archive.
    index: usize,
}

/// What is in an archive.
#[derive(Debug, Default)]
pub struct Listing {
    /// Its regular files.
    pub members: Vec<Member>,
    /// Its folders, with `/`.
    pub folders: Vec<String>,
    /// What is nothing of this.
    pub errors: Vec<ArchiveError>,
}

impl Listing {
    /// A link or device: nothing of it is taken, and its folder was there all the same.
    fn add_special(&mut self, path: &str) {
        if let Err(why) = check_special(path) {
            let folder = path.rsplit_once('/').map(|(folder, _)| folder.to_owned());
            self.folders.extend(folder);
            self.errors.push(why);
        }
    }
}

/// An archive, open.
#[derive(Debug)]
pub struct Archive(ArchiveReader);

#[derive(Debug)]
enum ArchiveReader {
    Zip(Box<ZipReader>),
    Tar(Tarball),
}

impl Archive {
    /// Of which kind it is, is seen by its first bytes.
    pub fn open(path: &Path) -> Result<Self, ArchiveError> {
        let mut head = Vec::new();
        let file = File::open(path).map_err(io_error)?;
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

    /// All that is in it. What leads outside, or is a link or device, is refused alone: in a class's
    /// archive that is one student's matter.
    pub fn listing(&mut self) -> Result<Listing, ArchiveError> {
        match &mut self.0 {
            ArchiveReader::Zip(zip) => zip.listing(),
            ArchiveReader::Tar(tar) => tar.listing(),
        }
    }

    /// Its regular files. Refused as a whole if any path leads outside, or is a link or device.
    pub fn members(&mut self) -> Result<Vec<Member>, ArchiveError> {
        let listing = self.listing()?;
        match listing.errors.into_iter().next() {
            Some(why) => Err(why),
            None => Ok(listing.members),
        }
    }

    /// The bytes of each of these members, in their order; of a longer one only the first
    /// `longest + 1`.
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

    /// How many members are read together at no higher cost: a tar is gone through each time.
    pub fn batch_size(&self) -> usize {
        match &self.0 {
            ArchiveReader::Zip(_) => 1,
            ArchiveReader::Tar(_) => MAX_MEMBERS,
        }
    }
}

/// What lies where this archive holds the five files.
pub(super) fn read(path: &Path) -> Result<SubmissionFiles, SubmissionError> {
    let refused = |why| SubmissionError::Archive {
        path: path.to_owned(),
        why,
    };
    let mut archive = Archive::open(path).map_err(refused)?;
    let members = archive.members().map_err(refused)?;
    let source = source_folder::find(members.iter().map(|member| member.path.as_str()));
    let source = source.map_err(|AmbiguousSource(folders)| SubmissionError::Ambiguous {
        path: path.to_owned(),
        folders: folders.iter().map(|folder| display_name(folder)).collect(),
    })?;
    let source = source.ok_or_else(|| SubmissionError::NoTaskFiles(path.to_owned()))?;

    let name = |member: &Member| {
        let (folder, name) = member.path.rsplit_once('/').unwrap_or(("", &member.path));
        (folder == source).then(|| name.to_owned())
    };
    let here: Vec<(String, &Member)> = members
        .iter()
        .filter_map(|member| Some((name(member)?, member)))
        .collect();
    let is_read =
        |(name, _): &&(String, &Member)| task_file_name(name).is_some() || is_given_file(name);
    let (read, others): (Vec<_>, Vec<_>) = here.iter().partition(is_read);
    let wanted: Vec<&Member> = read.iter().map(|(_, member)| *member).collect();

    let mut contents = SubmissionFiles::default();
    let bytes = archive.read(&wanted, MAX_FILE_BYTES).map_err(refused)?;
    for ((name, _), bytes) in read.iter().zip(bytes) {
        match task_file_name(name) {
            Some(name) => {
                let is_too_long = bytes.len() as u64 > MAX_FILE_BYTES;
                let bytes = match is_too_long {
                    true => Err(TaskFileError::TooLong(name)),
                    false => Ok(bytes),
                };
                contents.task_files.insert(name, bytes);
            }
            None => {
                contents.other_files.insert(name.clone(), bytes);
            }
        }
    }
    let others = others.iter().filter(|(name, _)| name.ends_with(".rs"));
    contents
        .other_files
        .extend(others.map(|(name, _)| (name.clone(), Vec::new())));
    Ok(contents)
}

/// The archive's name without what says that it is one.
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

/// A member's path, from whatever stands in the archive.
fn normalize_path(path: &str) -> Result<String, ArchiveError> {
    // Some programs on Windows write their own separator, against the standard.
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

/// A link or device. Cargo makes hard links in `target/`, and there nobody looks.
fn check_special(path: &str) -> Result<(), ArchiveError> {
    match path.split('/').any(|part| part == "target") {
        true => Ok(()),
        false => Err(ArchiveError::NotRegular(display_name(path))),
    }
}

fn io_error(error: io::Error) -> ArchiveError {
    ArchiveError::Io(error.kind().to_string())
}

#[cfg(test)]
mod tests;
