//! An export's archive, into a folder that vanishes: only what is looked at later, so that what one
//! student handed in besides fills nobody's disk. What can not be taken out is told, and the others
//! are not its matter.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Component, Path};

use grader::build::build_dir::BuildDir;
use grader::submission::{Archive, ArchiveError, Member};

use crate::input_error::ClassInputError;
use crate::layout::{CLASSROOM50_SCORES, METADATA, UnmatchedPath};
use crate::listing::is_archive_name;

/// The longest archive, or list of a platform's, that is taken out, in bytes.
const MAX_FILE_BYTES: u64 = 256 << 20;
/// The longest text; what is longer is seen to be.
const MAX_TEXT_BYTES: u64 = 1 << 20;
/// How much may come out of it, in bytes, beside so many times its own length: students' archives are
/// packed already, and their texts short.
const MAX_TOTAL_BYTES: u64 = 1 << 30;
const MAX_EXPANSION: u64 = 4;
/// Folders that nobody is graded by.
const SKIPPED: [&str; 4] = [".git", "target", "node_modules", "__MACOSX"];

/// Where in a room they are: there is a lock beside them.
pub const CLASS_FOLDER: &str = "class";

/// The archive's files and folders, in a room below `rooms`, and what was passed over.
pub fn unpack(
    path: &Path,
    rooms: &Path,
) -> Result<(BuildDir, Vec<UnmatchedPath>), ClassInputError> {
    let refused = |why| ClassInputError::Archive {
        path: path.to_owned(),
        why,
    };
    let at = |source| ClassInputError::Io {
        path: path.to_owned(),
        source,
    };
    let most = MAX_TOTAL_BYTES + MAX_EXPANSION * fs::metadata(path).map_err(at)?.len();
    let mut archive = Archive::open(path).map_err(refused)?;
    let listing = archive.listing().map_err(refused)?;
    let room = BuildDir::new_in(rooms).map_err(at)?;
    let folder = &room.path().join(CLASS_FOLDER);
    fs::create_dir(folder).map_err(at)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let passed_over = |why: String| UnmatchedPath {
        name: name.clone().into_owned(),
        why,
    };
    let mut others: Vec<UnmatchedPath> = listing
        .errors
        .iter()
        .map(|why| passed_over(why.to_string()))
        .collect();

    let wanted_folders = listing.folders.iter().filter(|path| is_wanted(path));
    for path in wanted_folders {
        let put = extract_to(folder, path, |place| fs::create_dir_all(place));
        others.extend(put.map_err(at)?.map(passed_over));
    }
    // A tar is gone through for each length, and not for each file.
    let mut by_length: BTreeMap<u64, Vec<&Member>> = BTreeMap::new();
    for member in listing.members.iter().filter(|m| is_wanted(&m.path)) {
        by_length
            .entry(max_bytes(&member.path))
            .or_default()
            .push(member);
    }
    let mut total = 0;
    for (longest, members) in by_length {
        // A few at a time, so that a big export needs little memory.
        for some in members.chunks(archive.batch_size()) {
            let contents = match longest {
                0 => vec![Vec::new(); some.len()],
                longest => archive.read(some, longest).map_err(refused)?,
            };
            for (member, bytes) in some.iter().zip(contents) {
                total += bytes.len() as u64;
                if total > most {
                    return Err(refused(ArchiveError::TooLarge(most)));
                }
                if longest == MAX_FILE_BYTES && bytes.len() as u64 > MAX_FILE_BYTES {
                    let mib = MAX_FILE_BYTES >> 20;
                    let path = &member.path;
                    others.push(passed_over(format!(
                        "{path} in it is longer than {mib} MiB, and cut: unpack all yourself, and name the folder"
                    )));
                }
                let put = extract_to(folder, &member.path, |place| {
                    fs::create_dir_all(place.parent().unwrap_or(place))?;
                    fs::write(place, &bytes)
                });
                others.extend(put.map_err(at)?.map(passed_over));
            }
        }
    }
    Ok((room, others))
}

fn is_wanted(path: &str) -> bool {
    !path.split('/').any(|part| SKIPPED.contains(&part))
}

/// How much of a file is looked at later. Of most it is only that they are there.
fn max_bytes(path: &str) -> u64 {
    let name = path.rsplit('/').next().unwrap_or(path);
    match name {
        METADATA | CLASSROOM50_SCORES => MAX_FILE_BYTES,
        name if is_archive_name(name) => MAX_FILE_BYTES,
        name if name.ends_with(".rs") => MAX_TEXT_BYTES,
        _ => 0,
    }
}

/// Puts something where `path` says, if a system can have such a path: if not, says so.
fn extract_to(
    folder: &Path,
    path: &str,
    put: impl Fn(&Path) -> io::Result<()>,
) -> io::Result<Option<String>> {
    let mut parts = Path::new(path).components();
    if !parts.all(|part| matches!(part, Component::Normal(_))) {
        return Ok(Some(format!("{path} in it is no path")));
    }
    match put(&folder.join(path)) {
        Ok(()) => Ok(None),
        // A name that is too long, or a file where a folder is meant: whoever packed that did it.
        Err(error) if !is_machine_fault(error.kind()) => Ok(Some(format!("{path} in it: {error}"))),
        Err(error) => Err(error),
    }
}

/// Whether that would befall any other file as well.
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
