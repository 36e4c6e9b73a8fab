//! Unpacks an export's archive into a temporary folder. Files that are not needed later are created
//! empty, so that they do not fill the disk. A file that cannot be unpacked is reported, and does
//! not affect the others.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path};

use grader::build::build_dir::BuildDir;
use grader::files::{self, AtPath, PathError};
use grader::submission::{Archive, ArchiveError, Member, is_archive_name};

use crate::input_error::ClassInputError;
use crate::layout::{CLASSROOM50_SCORES, METADATA, UnmatchedPath};

/// The maximum size of a student's archive or a platform's list, in bytes.
const MAX_FILE_BYTES: u64 = 256 << 20;
/// The maximum size of a source file, in bytes. Of a longer file, one byte more is unpacked, so
/// that the file is recognised as too long.
const MAX_TEXT_BYTES: u64 = 1 << 20;
/// The maximum total size of the unpacked files, in bytes, before [`MAX_EXPANSION`] times the size
/// of the archive is added. The sum is enough, since students' archives are already compressed and
/// their source files are short.
const MAX_TOTAL_BYTES: u64 = 1 << 30;
/// The number of bytes that each byte of the archive adds to [`MAX_TOTAL_BYTES`].
const MAX_EXPANSION: u64 = 4;
/// The names of folders that contain nothing to grade.
const SKIPPED: [&str; 4] = [".git", "target", "node_modules", "__MACOSX"];

/// The name of the folder for the unpacked files. It is in the temporary folder, which also
/// contains a lock file.
pub const CLASS_FOLDER: &str = "class";

/// Unpacks an archive into a temporary folder in `parent`. Also returns the paths that were not
/// unpacked.
pub fn unpack(
    path: &Path,
    parent: &Path,
) -> Result<(BuildDir, Vec<UnmatchedPath>), ClassInputError> {
    let archive_error = |why| ClassInputError::Archive {
        path: path.to_owned(),
        why,
    };
    let bytes = fs::metadata(path).at("read", path)?.len();
    let max_total = MAX_TOTAL_BYTES + MAX_EXPANSION * bytes;
    let mut archive = Archive::open(path).map_err(archive_error)?;
    let listing = archive.listing().map_err(archive_error)?;
    let build_dir = BuildDir::new_in(parent)?;
    let folder = &build_dir.path().join(CLASS_FOLDER);
    files::create_dir_all(folder)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let unmatched = |why: String| UnmatchedPath {
        name: name.clone().into_owned(),
        why,
    };
    let mut others: Vec<UnmatchedPath> = listing
        .errors
        .iter()
        .map(|why| unmatched(why.to_string()))
        .collect();

    let wanted_folders = listing.folders.iter().filter(|path| is_wanted(path));
    for path in wanted_folders {
        let put = extract_to(folder, path, |target| files::create_dir_all(target));
        others.extend(put?.map(unmatched));
    }
    // Grouped by the maximum size, so that a tar archive is read once per group and not once per
    // file.
    let mut by_max_bytes: BTreeMap<u64, Vec<&Member>> = BTreeMap::new();
    for member in listing.members.iter().filter(|m| is_wanted(&m.path)) {
        by_max_bytes
            .entry(max_bytes(&member.path))
            .or_default()
            .push(member);
    }
    let mut total = 0;
    for (max_bytes, members) in by_max_bytes {
        // Only a few files are read at a time, so that a large export needs little memory.
        for some in members.chunks(archive.batch_size()) {
            let contents = match max_bytes {
                0 => vec![Vec::new(); some.len()],
                max_bytes => archive.read(some, max_bytes).map_err(archive_error)?,
            };
            for (member, bytes) in some.iter().zip(contents) {
                total += bytes.len() as u64;
                if total > max_total {
                    return Err(archive_error(ArchiveError::TooLarge(max_total)));
                }
                if max_bytes == MAX_FILE_BYTES && bytes.len() as u64 > MAX_FILE_BYTES {
                    let mib = MAX_FILE_BYTES >> 20;
                    let path = &member.path;
                    others.push(unmatched(format!(
                        "{path} in it is longer than {mib} MiB and was cut off: unpack the archive \
                         yourself, and pass the folder"
                    )));
                }
                let put = extract_to(folder, &member.path, |target| {
                    files::write_with_parents(target, &bytes)
                });
                others.extend(put?.map(unmatched));
            }
        }
    }
    Ok((build_dir, others))
}

fn is_wanted(path: &str) -> bool {
    !path.split('/').any(|part| SKIPPED.contains(&part))
}

/// Returns the maximum number of bytes of a file that are needed later. For most files, it is 0,
/// since only their names matter.
fn max_bytes(path: &str) -> u64 {
    let name = path.rsplit('/').next().unwrap_or(path);
    match name {
        METADATA | CLASSROOM50_SCORES => MAX_FILE_BYTES,
        name if is_archive_name(name) => MAX_FILE_BYTES,
        name if name.ends_with(".rs") => MAX_TEXT_BYTES,
        _ => 0,
    }
}

/// Calls `put` with `path` joined to `folder`. Returns a message if such a path cannot exist on
/// this system.
fn extract_to(
    folder: &Path,
    path: &str,
    put: impl Fn(&Path) -> Result<(), PathError>,
) -> Result<Option<String>, PathError> {
    let mut parts = Path::new(path).components();
    if !parts.all(|part| matches!(part, Component::Normal(_))) {
        return Ok(Some(format!("{path} in it is not a valid path")));
    }
    match put(&folder.join(path)) {
        Ok(()) => Ok(None),
        // The archive is at fault if, for example, a name is too long, or a path is both a file and
        // a folder.
        Err(error) if !is_machine_fault(error.source.kind()) => {
            Ok(Some(format!("{path} in it: {}", error.reason())))
        }
        Err(error) => Err(error),
    }
}

/// Returns whether the machine is at fault, in which case any other file would cause the same
/// error.
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
