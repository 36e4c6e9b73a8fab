//! Chooses the folder of a submission to grade, without any I/O.
//!
//! People hand in more than they intend to: a copy at the top, an older version in a folder, or the
//! entire project. The folder with the most task files is graded. Other copies are ignored, with a
//! note, as long as they can't be what the student meant to hand in. Otherwise, a person has to
//! choose.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::names::{Resemblance, is_archive_name};
use super::{MAX_NOTES, SubmissionError, TaskFileError, display_name};
use crate::handed_out::{HandedOut, is_unwritten};

/// Names of folders that never contain handed-in files: metadata of systems and tools, old versions
/// kept by tools, and compiled files. The project's own folders are listed in the assignment.
const SKIPPED: [&str; 24] = [
    "__MACOSX",
    "target",
    "node_modules",
    ".git",
    ".github",
    ".gitlab",
    ".svn",
    ".hg",
    ".jj",
    ".cargo",
    ".vscode",
    ".vs",
    ".idea",
    ".fleet",
    ".zed",
    ".history",
    ".devcontainer",
    ".cache",
    ".Trash",
    ".Trashes",
    ".fseventsd",
    ".Spotlight-V100",
    ".TemporaryItems",
    ".DS_Store",
];

/// A folder, possibly in an archive, that contains task files.
#[derive(Debug, Default)]
pub(super) struct Candidate {
    /// The path of the folder below the submission, with `/`. Empty for its top level.
    pub(super) folder: String,
    /// The task files in the folder, by name.
    pub(super) task_files: BTreeMap<&'static str, FileContents>,
    /// Other Rust files by name, with their bytes if they need to be compared with given files.
    pub(super) other_files: BTreeMap<String, Vec<u8>>,
}

/// The choice of the folder to grade.
#[derive(Debug)]
pub(super) struct Choice {
    /// The chosen folder.
    pub(super) chosen: Candidate,
    /// Notes about ignored copies.
    pub(super) notes: Vec<String>,
    /// Whether every task file was found and differs from the starter's.
    pub(super) is_complete: bool,
}

/// A file in a folder or an archive that resembles a task file but isn't graded as one.
#[derive(Debug)]
pub(super) struct Lookalike {
    /// The path of the file below the submission, with `/`.
    pub(super) path: String,
    /// The name of the task file.
    pub(super) file: &'static str,
    /// How its name resembles the task file's.
    pub(super) kind: Resemblance,
    /// The contents of the file.
    pub(super) contents: FileContents,
}

/// Returns whether folders with this name are skipped in all assignments.
pub fn is_skipped_name(name: &str) -> bool {
    SKIPPED.contains(&name)
}

/// Returns whether folders with this name are skipped.
pub(super) fn is_skipped(name: &str, handed_out: &HandedOut) -> bool {
    is_skipped_name(name) || handed_out.assignment.other_folders.contains(&name)
}

/// Chooses the folder with the most task files that differ from the starter's. Returns `None` if
/// there are no candidates. `path` is the submission's path, for messages.
///
/// A folder is ignored if the chosen folder contains all of its files too. If the files differ,
/// there is a note. A folder that contains as many files as the chosen one, or a file that the
/// chosen one lacks, could be the one the student meant to hand in, so the result is an error. The
/// same is true for a changed copy, in an archive or under a different name, of a file that is
/// unmodified in the chosen folder. Other files that resemble task files are only noted.
pub(super) fn choose(
    path: &Path,
    mut candidates: Vec<Candidate>,
    mut lookalikes: Vec<Lookalike>,
    handed_out: &HandedOut,
) -> Result<Option<Choice>, SubmissionError> {
    let ambiguous = |copies: &[String]| SubmissionError::Ambiguous {
        path: path.to_owned(),
        copies: copies.iter().map(|copy| display_name(copy)).collect(),
    };
    candidates.sort_by_cached_key(|candidate| {
        (
            Reverse(candidate.written(handed_out).count()),
            Reverse(candidate.task_files.len()),
            rank(&candidate.folder, handed_out),
            candidate.folder.matches('/').count(),
            candidate.folder.clone(),
        )
    });
    let starters: BTreeSet<&str> = candidates
        .iter()
        .flat_map(|candidate| &candidate.task_files)
        .filter(|(name, contents)| is_starter(name, contents, handed_out))
        .map(|(name, _)| *name)
        .collect();
    let mut candidates = candidates.into_iter();
    let Some(chosen) = candidates.next() else {
        let copies = lookalikes.into_iter();
        let copies = copies.filter(|file| file.kind == Resemblance::Copy);
        let copies: Vec<String> = copies.map(|file| file.path).collect();
        return if copies.is_empty() {
            Ok(None)
        } else {
            Err(ambiguous(&copies))
        };
    };
    let written: Vec<&str> = chosen.written(handed_out).map(|(name, _)| name).collect();
    let mut notes = Vec::new();
    for other in candidates {
        let starters = chosen.archived_copies_of_starter(&other, handed_out);
        if !starters.is_empty() {
            let copies = starters.iter().map(|name| chosen.path_of(name));
            let copies = copies.collect();
            return Err(starter_beside_copies(path, starters, copies));
        }
        let files: Vec<_> = other.written(handed_out).collect();
        let differs = |(name, text): &&(&'static str, &FileContents)| {
            chosen.task_files.get(name) != Some(*text)
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
            return Err(ambiguous(&[chosen.folder, other.folder]));
        }
        notes.extend(differing.into_iter().map(|name| {
            let (ignored, used) = (other.path_of(name), chosen.path_of(name));
            display_name(&format!("{ignored} differs from {used}, and is ignored"))
        }));
    }
    lookalikes.sort_by(|one, other| one.path.cmp(&other.path));
    lookalikes.retain(|copy| {
        let is_graded = chosen.task_files.get(copy.file) == Some(&copy.contents);
        !is_graded && !is_starter(copy.file, &copy.contents, handed_out)
    });
    let is_untouched = |copy: &&Lookalike| match chosen.task_files.get(copy.file) {
        Some(graded) => is_starter(copy.file, graded, handed_out),
        None => starters.contains(copy.file),
    };
    let copies: Vec<&Lookalike> = lookalikes.iter().filter(is_untouched).collect();
    if !copies.is_empty() {
        let starters = copies.iter().map(|copy| copy.file).collect();
        let copies = copies.iter().map(|copy| copy.path.clone()).collect();
        return Err(starter_beside_copies(path, starters, copies));
    }
    let is_missing = |copy: &&Lookalike| !chosen.task_files.contains_key(copy.file);
    let missing = |copy: &&Lookalike| is_missing(copy) && copy.kind == Resemblance::Copy;
    if let Some(copy) = lookalikes.iter().find(missing) {
        let all = lookalikes.iter().filter(|other| other.file == copy.file);
        let all: Vec<String> = all.map(|copy| copy.path.clone()).collect();
        return Err(ambiguous(&all));
    }
    notes.extend(lookalikes.iter().map(|copy| {
        let Lookalike { path, file, .. } = copy;
        let end = if is_missing(&copy) {
            format!(
                "is not graded, since its name is not {file}: this costs {} points",
                points(file, handed_out)
            )
        } else {
            format!("differs from {}, and is ignored", chosen.path_of(file))
        };
        display_name(&format!("{path} {end}"))
    }));
    let more = notes.len().saturating_sub(MAX_NOTES);
    if more > 0 {
        notes.truncate(MAX_NOTES);
        notes.push(format!(
            "and {more} more files that resemble task files are not graded"
        ));
    }
    Ok(Some(Choice {
        is_complete: written.len() == handed_out.files.len(),
        notes,
        chosen,
    }))
}

/// The bytes of a task file, or why there are none.
pub(super) type FileContents = Result<Vec<u8>, TaskFileError>;

/// Returns the error for unmodified task files with changed copies. Each file is named once.
fn starter_beside_copies(
    path: &Path,
    starters: BTreeSet<&str>,
    copies: BTreeSet<String>,
) -> SubmissionError {
    SubmissionError::StarterBesideCopies {
        path: path.to_owned(),
        starters: starters.into_iter().map(display_name).collect(),
        copies: copies.iter().map(|copy| display_name(copy)).collect(),
    }
}

/// Returns the points of the tasks in a file.
fn points(file: &str, handed_out: &HandedOut) -> u32 {
    let tasks = handed_out.assignment.tasks.iter();
    tasks
        .filter(|task| task.file == file)
        .map(|task| task.points)
        .sum()
}

impl Candidate {
    /// Returns the task files that differ from the starter's.
    fn written<'a>(
        &'a self,
        handed_out: &'a HandedOut,
    ) -> impl Iterator<Item = (&'static str, &'a FileContents)> {
        let files = self.task_files.iter();
        files
            .filter(|(name, contents)| !is_starter(name, contents, handed_out))
            .map(|(name, contents)| (*name, contents))
    }

    /// Returns the files that are changed in this folder, which is in an archive, but are the
    /// starter's in another folder that isn't in an archive.
    fn archived_copies_of_starter(
        &self,
        other: &Candidate,
        handed_out: &HandedOut,
    ) -> BTreeSet<&'static str> {
        if !self.is_in_archive() || other.is_in_archive() {
            return BTreeSet::new();
        }
        let is_starter = |name: &&'static str| {
            let contents = other.task_files.get(name);
            contents.is_some_and(|contents| is_starter(name, contents, handed_out))
        };
        let written = self.written(handed_out).map(|(name, _)| name);
        written.filter(is_starter).collect()
    }

    /// Returns whether the folder is in an archive that is itself part of the submission.
    fn is_in_archive(&self) -> bool {
        self.folder.split('/').any(is_archive_name)
    }

    fn path_of(&self, name: &str) -> String {
        join(&self.folder, name)
    }
}

/// Returns whether a task file is unmodified.
pub(super) fn is_starter(name: &str, contents: &FileContents, handed_out: &HandedOut) -> bool {
    let text = contents
        .as_ref()
        .ok()
        .map(|bytes| std::str::from_utf8(bytes));
    let file = handed_out.task_file(name);
    matches!((file, text), (Some(file), Some(Ok(text))) if is_unwritten(file, text))
}

/// Returns the position of a folder in the assignment's list of folders, which may be at the top
/// level or in a folder there. Other folders come last.
fn rank(folder: &str, handed_out: &HandedOut) -> usize {
    let folders = handed_out.assignment.folders;
    let position = |folder: &str| folders.iter().position(|known| *known == folder);
    let below = folder.split_once('/').map_or("", |(_, below)| below);
    position(folder)
        .or_else(|| Some(folders.len() + position(below)?))
        .unwrap_or(2 * folders.len())
}

/// Joins two paths with `/`. Either one may be empty.
pub(super) fn join(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}

#[cfg(test)]
mod tests;
