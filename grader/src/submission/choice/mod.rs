//! Chooses which folder of a submission is graded, without any I/O.
//!
//! People hand in more than they mean to: a copy at the top, an older version in a folder, the whole
//! project. The folder with most of the task files counts. Other copies are ignored, with a note,
//! as long as they could not be what is meant; otherwise a person has to choose.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::{MAX_NOTES, SubmissionFiles, TaskFileError, display_name};
use crate::handed_out::{HandedOut, TaskFile};

/// Names of folders that never hold what is handed in: metadata of systems and tools, and compiled
/// files. Those of the project itself are in the assignment's table.
const SKIPPED: [&str; 3] = ["__MACOSX", "target", "node_modules"];

/// A folder, or an archive in it, that has task files.
#[derive(Debug, Default)]
pub(super) struct Candidate {
    /// The path of the folder below the submission, with `/`. Empty for its top level.
    pub(super) folder: String,
    /// The files in it.
    pub(super) files: SubmissionFiles,
}

/// The folder that is graded.
#[derive(Debug)]
pub(super) struct Choice {
    /// The chosen folder.
    pub(super) chosen: Candidate,
    /// Notes about the copies that are ignored.
    pub(super) notes: Vec<String>,
    /// Whether every task file was found, and differs from the starter's.
    pub(super) is_complete: bool,
}

/// The error for several folders that could be meant. Holds two of them.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct AmbiguousSource(pub(super) Vec<String>);

/// Returns whether nothing in a folder of this name is handed in.
pub(super) fn is_skipped(name: &str, handed_out: &HandedOut) -> bool {
    name.starts_with('.')
        || SKIPPED.contains(&name)
        || handed_out.assignment.other_folders.contains(&name)
}

/// Finds the task files among the names in one folder, and returns them with their own names. A
/// browser's copy such as `bvh (1).rs` counts as `bvh.rs` if it is the only one.
pub(super) fn task_files<'a>(
    names: &[&'a str],
    handed_out: &HandedOut,
) -> Result<BTreeMap<&'static str, &'a str>, AmbiguousSource> {
    let mut found: BTreeMap<&'static str, &str> = BTreeMap::new();
    for TaskFile { name: file, .. } in handed_out.files {
        if names.contains(file) {
            found.insert(file, file);
            continue;
        }
        let copies: Vec<&str> = names
            .iter()
            .copied()
            .filter(|name| is_numbered_copy(name, file))
            .collect();
        match copies[..] {
            [] => {}
            [only] => _ = found.insert(file, only),
            [..] => return Err(AmbiguousSource(copies.iter().map(|&n| n.into()).collect())),
        }
    }
    Ok(found)
}

/// Returns whether a browser would give this name to another download of the file: `bvh (1).rs`.
fn is_numbered_copy(name: &str, file: &str) -> bool {
    let stem = file.trim_end_matches(".rs");
    let number = name
        .strip_prefix(stem)
        .and_then(|rest| rest.strip_prefix(" ("))
        .and_then(|rest| rest.strip_suffix(").rs"));
    number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
}

/// Chooses the folder with most task files that differ from the starter's. `None` if there are no
/// candidates.
///
/// A folder whose files are all in the chosen one as well is ignored, with a note if they differ
/// there. A folder that has as much as the chosen one, or a file that the chosen one lacks, could
/// be what is meant: then the result is an error.
pub(super) fn choose(
    mut candidates: Vec<Candidate>,
    handed_out: &HandedOut,
) -> Result<Option<Choice>, AmbiguousSource> {
    candidates.sort_by_cached_key(|candidate| {
        (
            Reverse(candidate.written(handed_out).count()),
            Reverse(candidate.files.task_files.len()),
            rank(&candidate.folder, handed_out),
            candidate.folder.matches('/').count(),
            candidate.folder.clone(),
        )
    });
    let mut candidates = candidates.into_iter();
    let Some(chosen) = candidates.next() else {
        return Ok(None);
    };
    let written: Vec<&str> = chosen.written(handed_out).map(|(name, _)| name).collect();
    let mut notes = Vec::new();
    for other in candidates {
        let files: Vec<_> = other.written(handed_out).collect();
        let differs = |(name, text): &&(&'static str, &FileContents)| {
            chosen.files.task_files.get(name) != Some(*text)
        };
        let differing: Vec<&str> = files
            .iter()
            .filter(differs)
            .map(|(name, _)| *name)
            .collect();
        if differing.is_empty() {
            continue;
        }
        let is_less = files.len() < written.len() && files.iter().all(|(n, _)| written.contains(n));
        if !is_less {
            return Err(AmbiguousSource(vec![chosen.folder, other.folder]));
        }
        notes.extend(differing.into_iter().map(|name| {
            let (ignored, used) = (other.path_of(name), chosen.path_of(name));
            display_name(&format!("{ignored} differs from {used}, and is ignored"))
        }));
    }
    notes.truncate(MAX_NOTES);
    Ok(Some(Choice {
        is_complete: written.len() == handed_out.files.len(),
        notes,
        chosen,
    }))
}

/// The bytes of a task file, or the reason why it has none.
type FileContents = Result<Vec<u8>, TaskFileError>;

impl Candidate {
    /// Returns the task files that differ from the starter's.
    fn written<'a>(
        &'a self,
        handed_out: &'a HandedOut,
    ) -> impl Iterator<Item = (&'static str, &'a FileContents)> {
        let files = self.files.task_files.iter();
        files
            .filter(|(name, contents)| !is_starter(name, contents, handed_out))
            .map(|(name, contents)| (*name, contents))
    }

    fn path_of(&self, name: &str) -> String {
        join(&self.folder, name)
    }
}

fn is_starter(name: &str, contents: &FileContents, handed_out: &HandedOut) -> bool {
    let text = contents
        .as_ref()
        .ok()
        .map(|bytes| std::str::from_utf8(bytes));
    let file = handed_out.task_file(name);
    matches!((file, text), (Some(file), Some(Ok(text))) if file.is_starter(text))
}

/// Returns the position of a folder in the assignment's list of folders, below the top or below a
/// folder there. Other folders come last.
fn rank(folder: &str, handed_out: &HandedOut) -> usize {
    let folders = handed_out.assignment.folders;
    let position = |folder: &str| folders.iter().position(|known| *known == folder);
    let below = folder.split_once('/').map_or("", |(_, below)| below);
    position(folder)
        .or_else(|| Some(folders.len() + position(below)?))
        .unwrap_or(2 * folders.len())
}

/// Joins two paths with `/`. Either may be empty.
pub(super) fn join(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}

#[cfg(test)]
mod tests;
