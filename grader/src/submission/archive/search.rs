//! Looks for task files in an archive, and in the archives in it.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::{Archive, ArchiveBytes, ArchiveError, ArchiveLimits, MAX_LEVELS, Member};
use crate::handed_out::HandedOut;
use crate::submission::budget::Limit;
use crate::submission::choice::{is_skipped, join};
use crate::submission::found::{FoundFolder, is_read};
use crate::submission::names::is_archive_name;
use crate::submission::search::Search;
use crate::submission::{MAX_FILE_BYTES, SubmissionError};

/// The maximum size of an archive in another one, in bytes.
const MAX_INNER_BYTES: u64 = 64 << 20;

/// Adds the folders of an archive that have task files, or copies of them, to a search. `name` is put
/// in front of their paths. An archive in it that cannot be read is one of the search's errors.
/// Returns the names at the archive's top level.
pub(in crate::submission) fn search(
    bytes: ArchiveBytes,
    name: &str,
    search: &mut Search,
    handed_out: &'static HandedOut,
) -> Result<Vec<String>, SubmissionError> {
    search_level(bytes, name, search, handed_out, 1)
}

/// Why the archives in an archive were not all read.
enum Stopped {
    Archive(ArchiveError),
    Search(SubmissionError),
}

impl From<ArchiveError> for Stopped {
    fn from(error: ArchiveError) -> Self {
        Stopped::Archive(error)
    }
}

impl From<SubmissionError> for Stopped {
    fn from(error: SubmissionError) -> Self {
        Stopped::Search(error)
    }
}

/// Returns the bytes of an archive in an archive.
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

fn search_level(
    bytes: ArchiveBytes,
    name: &str,
    search: &mut Search,
    handed_out: &'static HandedOut,
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
    let limits = ArchiveLimits::submission(&search.budget.bytes);
    let mut archive = Archive::open_bytes(bytes, limits).map_err(rejected)?;
    let members = archive.members().map_err(rejected)?;
    search.spend(Limit::Files, members.len())?;

    let mut folders: BTreeMap<&str, Vec<(&str, &Member)>> = BTreeMap::new();
    let mut inner = Vec::new();
    for member in &members {
        let (folder, file) = member.path.rsplit_once('/').unwrap_or(("", &member.path));
        if folder.split('/').any(|part| is_skipped(part, handed_out)) {
        } else if is_archive_name(file) {
            inner.push(member);
        } else {
            folders.entry(folder).or_default().push((file, member));
        }
    }
    // Everything is read at once, since each call scans a tar.
    let mut found = Vec::new();
    let mut requested: Vec<(&Member, u64)> = Vec::new();
    let mut indices = Vec::new();
    for (folder, files) in folders {
        let mut folder = FoundFolder::new(join(name, folder));
        for (file, member) in files {
            if is_read(file, handed_out) {
                requested.push((member, MAX_FILE_BYTES));
                indices.push((found.len(), file));
            } else {
                folder.others.push(file.to_owned());
            }
        }
        found.push(folder);
    }
    search.spend(Limit::Copies, requested.len())?;
    archive
        .read_each(&requested, |slot, bytes| {
            let (folder, file) = indices[slot];
            found[folder].read.push((file.to_owned(), Ok(bytes?)));
            Ok::<_, ArchiveError>(())
        })
        .map_err(rejected)?;
    for folder in found {
        search.add_folder(folder, handed_out)?;
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
            let found =
                found.and_then(|bytes| search_level(bytes, &inner, search, handed_out, level + 1));
            search.check_bytes()?;
            search.keep_error(&inner, found)?;
            Ok::<_, Stopped>(())
        });
        match read {
            Ok(()) => {}
            Err(Stopped::Archive(why)) => return Err(rejected(why)),
            Err(Stopped::Search(error)) => return Err(error),
        }
    }
    let names = members.iter().map(|member| {
        let (top, _) = member.path.split_once('/').unwrap_or((&member.path, ""));
        top.to_owned()
    });
    let names: BTreeSet<String> = names.collect();
    Ok(names.into_iter().collect())
}
