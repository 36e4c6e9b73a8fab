//! Unpacks an export's archive into a temporary folder. Files that aren't needed later are created
//! empty, so that they don't fill the disk. A file that cannot be unpacked is reported without
//! affecting the others.

use std::collections::BTreeSet;
use std::error::Error as StdError;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path};

use grader::build::build_dir::BuildDir;
use grader::files::{self, AtPath, PathError};
use grader::handed_out::HandedOut;
use grader::submission::{
    Archive, ArchiveLimits, Member, is_archive_name, is_skipped_name, may_be_task_file,
};

use crate::error::Error;
use crate::layout::{UnmatchedPath, is_record};

/// The maximum size of a student's archive or a platform's list, in bytes.
const MAX_FILE_BYTES: u64 = 256 << 20;
/// The maximum size of a source file, in bytes. For a longer file, one more byte is unpacked, so
/// that it is recognised as too long.
const MAX_TEXT_BYTES: u64 = 1 << 20;
/// The fixed part of the maximum total size of the unpacked files, in bytes. [`MAX_EXPANSION`]
/// times the archive's size is added to it. The sum is large enough, since students' archives are
/// already compressed and their source files are short.
const MAX_TOTAL_BYTES: u64 = 1 << 30;
/// The number of bytes that each byte of the archive adds to [`MAX_TOTAL_BYTES`].
const MAX_EXPANSION: u64 = 4;

/// The name of the folder for the unpacked files. It is inside the temporary folder, which also
/// contains a lock file.
pub const CLASS_FOLDER: &str = "class";

/// The unpacked files of an archive.
pub struct UnpackedArchive {
    /// The temporary folder. The files are in its subfolder [`CLASS_FOLDER`].
    pub build_dir: BuildDir,
    /// The members that cannot be unpacked.
    pub problems: Vec<UnmatchedPath>,
    /// The files that are needed but are empty because they could not be unpacked. Each is
    /// identified by its path in the folder.
    pub incomplete: Vec<UnmatchedPath>,
}

/// Unpacks an archive into a temporary folder in `parent`.
pub fn unpack(
    path: &Path,
    parent: &Path,
    handed_out: &HandedOut,
) -> Result<UnpackedArchive, Error> {
    unpack_files(path, parent, handed_out).map_err(|why| {
        let path = path.display();
        Error::user(format!(
            "{path}: {why}; alternatively, unpack the archive yourself and pass the path of the folder"
        ))
    })
}

fn unpack_files(
    path: &Path,
    parent: &Path,
    handed_out: &HandedOut,
) -> Result<UnpackedArchive, Box<dyn StdError>> {
    let bytes = fs::metadata(path).at("read", path)?.len();
    let mut archive = Archive::open(path, ArchiveLimits::class())?;
    let listing = archive.listing()?;
    let build_dir = BuildDir::new_in(parent)?;
    let folder = &build_dir.path().join(CLASS_FOLDER);
    files::create_dir_all(folder)?;
    let errors = listing.errors.iter();
    let mut problems: Vec<String> = errors.map(ToString::to_string).collect();
    let members = listing.members.iter();
    let paths = members.map(|member| &member.path).chain(&listing.folders);
    let clones = paths.filter_map(|path| git_folder(path));
    let folders = listing.folders.iter().filter(|path| is_wanted(path));
    let folders: BTreeSet<String> = folders.cloned().chain(clones).collect();
    for path in &folders {
        let put = extract_to(folder, path, |target| files::create_dir_all(target));
        problems.extend(put?);
    }

    let members = listing.members.iter();
    let members = members.filter(|member| is_wanted(&member.path));
    let (read, not_read) = select(members, MAX_TOTAL_BYTES + MAX_EXPANSION * bytes, handed_out);
    let mut incomplete = Vec::new();
    let mut put = |member: &Member, bytes: Result<&[u8], String>| {
        let bytes = bytes.unwrap_or_else(|why| {
            incomplete.push(UnmatchedPath::new(&member.path, why));
            &[]
        });
        let put = extract_to(folder, &member.path, |target| {
            files::write_with_parents(target, bytes)
        });
        problems.extend(put?);
        Ok::<_, Box<dyn StdError>>(())
    };
    for (member, why) in not_read {
        put(member, why.map_or(Ok(&[]), Err))?;
    }
    archive.read_each(&read, |slot, bytes| match bytes {
        Ok(bytes) => put(read[slot].0, Ok(&bytes)),
        Err(why) => put(read[slot].0, Err(why.to_string())),
    })?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let problems = problems.into_iter();
    let problems = problems.map(|why| UnmatchedPath::new(name.clone(), why));
    Ok(UnpackedArchive {
        build_dir,
        problems: problems.collect(),
        incomplete,
    })
}

/// The archive members to read (and how many bytes of each), and the members to create as empty
/// files. The string is present if the file's contents would be needed, and says why it is created
/// empty.
type Selection<'a> = (Vec<(&'a Member, u64)>, Vec<(&'a Member, Option<String>)>);

/// Selects the members whose contents are needed. The smallest come first, so that only the largest
/// are dropped if not all fit. No member can have more bytes than it claims.
fn select<'a>(
    members: impl Iterator<Item = &'a Member>,
    max_total: u64,
    handed_out: &HandedOut,
) -> Selection<'a> {
    let needed =
        |member: &'a Member| (member, max_bytes(&member.path, handed_out).min(member.size));
    let mut needed: Vec<_> = members.map(needed).collect();
    needed.sort_by_key(|(_, bytes)| *bytes);
    let (mut read, mut not_read) = (Vec::new(), Vec::new());
    let mut total = 0;
    for (member, bytes) in needed {
        total += bytes;
        let (size, most) = (member.size >> 20, MAX_FILE_BYTES >> 20);
        let why = if bytes == 0 {
            None
        } else if bytes == MAX_FILE_BYTES && member.size > MAX_FILE_BYTES {
            Some(format!(
                "it is {size} MiB, but the limit is {most} MiB: ask the student for \
                 the task files only"
            ))
        } else if total > max_total {
            Some(format!(
                "it is {size} MiB, which is too large to unpack along with the class's smaller \
                 files: unpack the archive yourself and pass the folder"
            ))
        } else {
            read.push((member, bytes));
            continue;
        };
        not_read.push((member, why));
    }
    (read, not_read)
}

fn is_wanted(path: &str) -> bool {
    !path.split('/').any(is_skipped_name)
}

/// Returns the path of the folder `.git` in a clone that contains the file or folder at `path`. This
/// folder is created empty, since it is only needed to recognise the clone.
fn git_folder(path: &str) -> Option<String> {
    let path = format!("/{path}/");
    let (clone, _) = path.split_once("/.git/")?;
    is_wanted(clone).then(|| format!("{clone}/.git").trim_start_matches('/').to_owned())
}

/// Returns how many bytes of a file can be needed later. This is 0 for most files, since only their
/// names matter.
fn max_bytes(path: &str, handed_out: &HandedOut) -> u64 {
    let name = path.rsplit('/').next().unwrap_or(path);
    match name {
        name if is_record(name) => MAX_FILE_BYTES,
        name if is_archive_name(name) => MAX_FILE_BYTES,
        name if name.ends_with(".rs") || may_be_task_file(name, handed_out) => MAX_TEXT_BYTES,
        _ => 0,
    }
}

/// Calls `put` with `path` joined to `folder`. Returns a message if the resulting path cannot exist
/// on this system.
fn extract_to(
    folder: &Path,
    path: &str,
    put: impl Fn(&Path) -> Result<(), PathError>,
) -> Result<Option<String>, PathError> {
    let mut parts = Path::new(path).components();
    if !parts.all(|part| matches!(part, Component::Normal(_))) {
        return Ok(Some(format!("it contains an invalid path: {path}")));
    }
    match put(&folder.join(path)) {
        Ok(()) => Ok(None),
        // The archive is at fault, e.g. a name is too long, or a path is both a file and a folder.
        Err(error) if !is_machine_fault(error.source.kind()) => Ok(Some(format!(
            "it contains {path}, which cannot be unpacked: {}",
            error.reason()
        ))),
        Err(error) => Err(error),
    }
}

/// Returns whether the machine is at fault. If so, any other file would cause the same error.
fn is_machine_fault(kind: ErrorKind) -> bool {
    matches!(
        kind,
        ErrorKind::StorageFull
            | ErrorKind::QuotaExceeded
            | ErrorKind::FileTooLarge
            | ErrorKind::ReadOnlyFilesystem
            | ErrorKind::PermissionDenied
            | ErrorKind::OutOfMemory
    )
}
