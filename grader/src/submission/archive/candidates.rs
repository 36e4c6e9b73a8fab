//! Reads the folders with task files in an archive.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::{Archive, ArchiveError, Member};
use crate::handed_out::{HandedOut, TaskFile};
use crate::submission::choice::{self, Candidate, join};
use crate::submission::error::ambiguous;
use crate::submission::{MAX_FILE_BYTES, SubmissionError, TaskFileError};

/// The maximum number of folders with task files in an archive.
const MAX_FOLDERS: usize = 32;

/// Reads the folders of an archive that have task files, with the Rust files beside them. `name` is
/// put in front of their paths. Also returns the names at the archive's top level.
pub(in crate::submission) fn candidates(
    path: &Path,
    name: &str,
    handed_out: &'static HandedOut,
) -> Result<(Vec<Candidate>, Vec<String>), SubmissionError> {
    let rejected = |why| SubmissionError::Archive {
        path: path.to_owned(),
        why,
    };
    let mut archive = Archive::open(path).map_err(rejected)?;
    let members = archive.members().map_err(rejected)?;
    let mut folders: BTreeMap<&str, Vec<(&str, &Member)>> = BTreeMap::new();
    for member in &members {
        let (folder, name) = member.path.rsplit_once('/').unwrap_or(("", &member.path));
        let is_skipped = folder
            .split('/')
            .any(|name| choice::is_skipped(name, handed_out));
        if name.ends_with(".rs") && !is_skipped {
            folders.entry(folder).or_default().push((name, member));
        }
    }
    let mut candidates = Vec::new();
    // The members to read, with the indices of their folders and their names in the candidate.
    let mut requested: Vec<(&Member, usize, &str)> = Vec::new();
    for (folder, files) in folders {
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        let found = choice::task_files(&names, handed_out);
        let found = found.map_err(|error| ambiguous(path, error))?;
        if found.is_empty() {
            continue;
        }
        let mut candidate = Candidate {
            folder: join(name, folder),
            ..Candidate::default()
        };
        for (name, member) in files {
            let task_file = found.iter().find(|(_, used)| **used == name);
            if let Some((task_file, _)) = task_file {
                requested.push((member, candidates.len(), task_file));
            } else if handed_out.given_file(name).is_some() {
                requested.push((member, candidates.len(), name));
            } else {
                candidate
                    .files
                    .other_files
                    .insert(name.to_owned(), Vec::new());
            }
        }
        candidates.push(candidate);
    }
    if candidates.len() > MAX_FOLDERS {
        return Err(rejected(ArchiveError::TooManyFiles));
    }
    let wanted: Vec<&Member> = requested.iter().map(|(member, ..)| *member).collect();
    let contents = archive.read(&wanted, MAX_FILE_BYTES).map_err(rejected)?;
    for ((_, index, name), bytes) in requested.into_iter().zip(contents) {
        let files = &mut candidates[index].files;
        match handed_out.task_file(name) {
            Some(TaskFile { name, .. }) if bytes.len() as u64 > MAX_FILE_BYTES => {
                files
                    .task_files
                    .insert(name, Err(TaskFileError::TooLong(name)));
            }
            Some(TaskFile { name, .. }) => _ = files.task_files.insert(name, Ok(bytes)),
            None => _ = files.other_files.insert(name.to_owned(), bytes),
        }
    }
    let names = members.iter().map(|member| {
        let (top, _) = member.path.split_once('/').unwrap_or((&member.path, ""));
        top.to_owned()
    });
    let names: BTreeSet<String> = names.collect();
    Ok((candidates, names.into_iter().collect()))
}
