//! Searches an archive and the archives nested in it for task files.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::{Archive, ArchiveBytes, ArchiveError, ArchiveLimits, MAX_LEVELS, Member};
use crate::submission::candidate::join;
use crate::submission::limit::Limit;
use crate::submission::names::is_archive_name;
use crate::submission::search::{FoundFolder, Search};
use crate::submission::skipped::is_skipped;
use crate::submission::{MAX_FILE_BYTES, SubmissionError};

/// The maximum size of a nested archive, in bytes.
const MAX_INNER_BYTES: u64 = 64 << 20;

/// Why the reader stopped early when unpacking nested archives.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
enum StopReason {
    Archive(#[from] ArchiveError),
    Search(#[from] SubmissionError),
}

/// Returns the bytes of a nested archive.
fn inner_archive(
    bytes: Result<Vec<u8>, ArchiveError>,
    level: usize,
) -> Result<ArchiveBytes, ArchiveError> {
    let bytes = bytes?;
    if level == MAX_LEVELS {
        Err(ArchiveError::TooDeep)
    } else if bytes.len() as u64 > MAX_INNER_BYTES {
        Err(ArchiveError::TooLarge(MAX_INNER_BYTES))
    } else {
        Ok(ArchiveBytes::Member(Rc::from(bytes)))
    }
}

/// Searches an archive. Adds to `search` the archive's folders that contain task files or copies of
/// task files, with `name` prepended to their paths. `level` is 1 unless the archive is nested. A
/// nested archive that cannot be read is added to the search's errors. Returns the names at the
/// archive's top level.
pub(in crate::submission) fn search(
    bytes: ArchiveBytes,
    name: &str,
    search: &mut Search,
    level: usize,
) -> Result<Vec<String>, SubmissionError> {
    search.spend(Limit::Archives, 1)?;
    let path = match name {
        "" => search.submission.clone(),
        name => search.submission.join(name),
    };
    let rejected = |why| SubmissionError::Archive {
        path: path.clone(),
        why,
    };
    let limits = ArchiveLimits::submission(&search.bytes);
    let mut archive = Archive::open_bytes(bytes, limits).map_err(rejected)?;
    let members = archive.members().map_err(rejected)?;
    search.spend(Limit::Files, members.len())?;

    let mut folders: BTreeMap<&str, Vec<(&str, &Member)>> = BTreeMap::new();
    let mut inner = Vec::new();
    for member in &members {
        let (folder, file) = member.path.rsplit_once('/').unwrap_or(("", &member.path));
        if folder
            .split('/')
            .any(|part| is_skipped(part, search.handed_out))
        {
        } else if is_archive_name(file) {
            inner.push(member);
        } else {
            folders.entry(folder).or_default().push((file, member));
        }
    }
    // Read everything at once, since each call scans the entire tar.
    let mut found = Vec::new();
    let mut requested: Vec<&Member> = Vec::new();
    let mut indices = Vec::new();
    for (folder, files) in folders {
        let mut folder = FoundFolder {
            path: join(name, folder),
            ..FoundFolder::default()
        };
        for (file, member) in files {
            if search.is_read(file) {
                requested.push(member);
                indices.push((found.len(), file));
            } else {
                folder.others.push(file.to_owned());
            }
        }
        found.push(folder);
    }
    search.spend(Limit::Copies, requested.len())?;
    let contents = archive.read(&requested, MAX_FILE_BYTES).map_err(rejected)?;
    for ((folder, file), bytes) in indices.into_iter().zip(contents) {
        found[folder].read.push((file.to_owned(), Ok(bytes)));
    }
    for folder in found {
        search.add_folder(folder)?;
    }
    let requested: Vec<(&Member, u64)> = inner
        .iter()
        .map(|member| (*member, MAX_INNER_BYTES))
        .collect();
    if !requested.is_empty() {
        let read = archive.read_each(&requested, |slot, bytes| {
            let inner = join(name, &requested[slot].0.path);
            let found = inner_archive(bytes, level);
            let found = found.map_err(|why| SubmissionError::Archive {
                path: search.submission.join(&inner),
                why,
            });
            let found = found.and_then(|bytes| self::search(bytes, &inner, search, level + 1));
            search.check_bytes()?;
            search.keep_error(&inner, found)?;
            Ok::<_, StopReason>(())
        });
        match read {
            Ok(()) => {}
            Err(StopReason::Archive(why)) => return Err(rejected(why)),
            Err(StopReason::Search(error)) => return Err(error),
        }
    }
    let names = members.iter().map(|member| {
        let (top, _) = member.path.split_once('/').unwrap_or((&member.path, ""));
        top.to_owned()
    });
    let names: BTreeSet<String> = names.collect();
    Ok(names.into_iter().collect())
}
