//! Chooses which folder of a submission to grade, without any I/O.
//!
//! People hand in more than they intend to: a copy at the top level, an older version in a folder,
//! or the entire project. The folder with the most task files is graded. Other copies are ignored,
//! with a note, as long as they can't be what the student meant to hand in. If the task files are
//! spread over several folders and there is only one version of each, they are graded together.
//! Otherwise, a person has to choose.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::names::{Resemblance, is_archive_name};
use super::{MAX_NOTES, SubmissionError, TaskFileError, display_name};
use crate::handed_out::{HandedOut, is_unwritten};

/// Names of folders that never contain files to grade, but only metadata of systems and tools, old
/// versions kept by tools, or compiled files. The project's own folders are listed in the
/// assignment.
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
    /// The path of the folder below the submission, with `/` as the separator. Empty for the
    /// submission's top level.
    pub(super) folder: String,
    /// The task files in the folder, keyed by name.
    pub(super) task_files: BTreeMap<&'static str, FileContents>,
    /// The paths of the task files that have a different name or are in a different folder, keyed
    /// by the task file's name.
    pub(super) other_paths: BTreeMap<&'static str, String>,
    /// Other Rust files, keyed by name, with their bytes if they need to be compared with given
    /// files.
    pub(super) other_files: BTreeMap<String, Vec<u8>>,
}

/// The choice of the folder to grade.
#[derive(Debug)]
pub(super) struct Choice {
    /// The chosen folder, or the task files of several folders.
    pub(super) chosen: Candidate,
    /// Notes about ignored copies, and about files that are graded under a different name.
    pub(super) notes: Vec<String>,
    /// Whether every task file was found and differs from the starter's.
    pub(super) is_complete: bool,
}

/// A file in a folder or an archive that resembles a task file but isn't graded as one.
#[derive(Debug)]
pub(super) struct Lookalike {
    /// The path of the file below the submission, with `/` as the separator.
    pub(super) path: String,
    /// The name of the task file.
    pub(super) file: &'static str,
    /// How the file's name resembles the task file's name.
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

/// Chooses the task files to grade, as described in [`choose_folder`]. Returns `None` if there are
/// no candidates. `path` is the submission's path, for use in messages.
///
/// The result is an error if there is a different copy next to a chosen file, or if a chosen file
/// is unmodified, but a changed copy of it exists under a different name. Other files that resemble
/// task files are only noted.
pub(super) fn choose(
    path: &Path,
    mut candidates: Vec<Candidate>,
    mut lookalikes: Vec<Lookalike>,
    handed_out: &HandedOut,
) -> Result<Option<Choice>, SubmissionError> {
    lookalikes.sort_by(|one, other| one.path.cmp(&other.path));
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
    if candidates.is_empty() {
        let mut copies = lookalikes.iter();
        let copy = copies.find(|file| file.kind == Resemblance::Copy);
        return copy.map_or(Ok(None), |copy| {
            let is_meant =
                |other: &&Lookalike| other.kind == Resemblance::Copy && other.file == copy.file;
            let all = lookalikes.iter().filter(is_meant);
            let all = all.map(|copy| copy.path.as_str()).collect();
            Err(ambiguous(path, &[copy.file], all))
        });
    }
    let (chosen, mut notes) = choose_folder(path, candidates, handed_out)?;
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
    let is_beside = |copy: &&Lookalike| {
        let graded = chosen.path_of(copy.file);
        copy.kind == Resemblance::Copy
            && chosen.task_files.contains_key(copy.file)
            && parent(&copy.path) == parent(&graded)
    };
    if let Some(copy) = lookalikes.iter().find(is_beside) {
        let graded = chosen.path_of(copy.file);
        return Err(ambiguous(path, &[copy.file], vec![&graded, &copy.path]));
    }
    let is_missing = |copy: &&Lookalike| !chosen.task_files.contains_key(copy.file);
    let missing = |copy: &&Lookalike| is_missing(copy) && copy.kind == Resemblance::Copy;
    if let Some(copy) = lookalikes.iter().find(missing) {
        let all = lookalikes.iter().filter(|other| other.file == copy.file);
        let all = all.map(|copy| copy.path.as_str()).collect();
        return Err(ambiguous(path, &[copy.file], all));
    }
    notes.extend(lookalikes.iter().map(|copy| {
        let Lookalike { path, file, .. } = copy;
        let end = if is_missing(&copy) {
            format!(
                "is not graded because its name is not {file}; this costs {} points",
                points(file, handed_out)
            )
        } else {
            format!("differs from {} and is ignored", chosen.path_of(file))
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
        is_complete: chosen.written(handed_out).count() == handed_out.files.len(),
        notes,
        chosen,
    }))
}

/// Chooses the first of these candidates, which is the folder with the most task files that differ
/// from the starter's. Returns notes about the other folders and about files with different names.
///
/// A folder is ignored if the chosen folder contains all of its files too. If a file differs
/// between the two folders, a note says so. A folder that contains as many files as the chosen one,
/// or a file that the chosen one lacks, could be the one the student meant to hand in, so the files
/// of all folders are [combined](combine). The result is an error if a file is changed in a chosen
/// archive but unmodified outside it.
fn choose_folder(
    path: &Path,
    mut candidates: Vec<Candidate>,
    handed_out: &HandedOut,
) -> Result<(Candidate, Vec<String>), SubmissionError> {
    let first = &candidates[0];
    let mut ignored = Vec::new();
    let mut is_enough = true;
    for other in &candidates[1..] {
        match first.differing_files(other, handed_out) {
            Some(names) => ignored.extend(names.into_iter().map(|name| {
                let (ignored, used) = (other.path_of(name), first.path_of(name));
                display_name(&format!("{ignored} differs from {used} and is ignored"))
            })),
            None => is_enough = false,
        }
    }
    let chosen = if is_enough {
        for other in &candidates[1..] {
            let starters = first.archived_copies_of_starter(other, handed_out);
            if !starters.is_empty() {
                let copies = starters.iter().map(|name| first.path_of(name));
                let copies = copies.collect();
                return Err(starter_beside_copies(path, starters, copies));
            }
        }
        candidates.swap_remove(0)
    } else {
        ignored.clear();
        combine(path, &candidates, handed_out)?
    };
    let mut notes = chosen.notes_on_names();
    notes.extend(ignored);
    Ok((chosen, notes))
}

/// Combines the task files in several folders. If a file is modified in some folders but not in
/// others, the modified version is used. Fails if there are different versions of a file.
fn combine(
    path: &Path,
    candidates: &[Candidate],
    handed_out: &HandedOut,
) -> Result<Candidate, SubmissionError> {
    let mut used: BTreeMap<&'static str, &Candidate> = BTreeMap::new();
    for candidate in candidates {
        for (name, contents) in candidate.written(handed_out) {
            let first = *used.entry(name).or_insert(candidate);
            if first.task_files.get(name) != Some(contents) {
                return Err(first.conflict(candidate, name, path, handed_out));
            }
        }
    }
    for candidate in candidates {
        for name in candidate.task_files.keys() {
            used.entry(name).or_insert(candidate);
        }
    }
    let file = |(name, from): (&&'static str, &&Candidate)| {
        from.task_files.get(name).map(|file| (*name, file.clone()))
    };
    // If other files have the same name, the one in the first folder is used.
    let others = candidates.iter().rev();
    let others = others.flat_map(|candidate| candidate.other_files.clone());
    Ok(Candidate {
        folder: candidates[0].folder.clone(),
        task_files: used.iter().filter_map(file).collect(),
        other_paths: used
            .iter()
            .map(|(name, from)| (*name, from.path_of(name)))
            .collect(),
        other_files: others.collect(),
    })
}

/// The bytes of a task file, or the reason there are none.
pub(super) type FileContents = Result<Vec<u8>, TaskFileError>;

/// Returns the error to report when there are differing copies of these task files.
fn ambiguous(path: &Path, files: &[&str], copies: Vec<&str>) -> SubmissionError {
    SubmissionError::Ambiguous {
        path: path.to_owned(),
        files: files.iter().map(|file| display_name(file)).collect(),
        copies: copies.into_iter().map(display_name).collect(),
    }
}

/// Returns the error to report when task files are unmodified even though changed copies of
/// them exist. The error names each file once.
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

/// Returns the points for the tasks in a file.
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

    /// Returns the files that are modified in the other folder and differ from this folder's
    /// versions. Returns `None` if the other folder could be the one that the student meant to hand
    /// in.
    fn differing_files(
        &self,
        other: &Candidate,
        handed_out: &HandedOut,
    ) -> Option<Vec<&'static str>> {
        let written: Vec<&str> = self.written(handed_out).map(|(name, _)| name).collect();
        let files: Vec<_> = other.written(handed_out).collect();
        let is_less = files.len() < written.len() && files.iter().all(|(n, _)| written.contains(n));
        let differing = files.into_iter();
        let differing = differing.filter(|(name, text)| self.task_files.get(name) != Some(*text));
        let differing: Vec<&str> = differing.map(|(name, _)| name).collect();
        (is_less || differing.is_empty()).then_some(differing)
    }

    /// Returns the error to report when two folders contain different versions of a task file. It
    /// also names any other files that differ between the same two folders.
    fn conflict(
        &self,
        other: &Candidate,
        name: &str,
        path: &Path,
        handed_out: &HandedOut,
    ) -> SubmissionError {
        let places = |name: &str| [self.place_of(name), other.place_of(name)];
        let differs = |(file, contents): &(&'static str, &FileContents)| {
            let own = self.written(handed_out).find(|(own, _)| own == file);
            own.is_some_and(|(_, own)| own != *contents) && places(file) == places(name)
        };
        let files = other.written(handed_out).filter(differs);
        let files: Vec<&str> = files.map(|(file, _)| file).collect();
        ambiguous(
            path,
            &files,
            places(name).iter().map(String::as_str).collect(),
        )
    }

    /// Returns notes about the files that are graded under a different name.
    fn notes_on_names(&self) -> Vec<String> {
        let paths = self.other_paths.iter();
        let renamed = paths.filter(|(name, path)| path.rsplit('/').next() != Some(name));
        let note = |(name, path)| display_name(&format!("{path} is graded as {name}"));
        renamed.map(note).collect()
    }

    /// Returns the files that are changed in this folder but unmodified in the other one, if this
    /// folder is in an archive and the other one isn't.
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

    /// Returns the path of a task file below the submission.
    pub(super) fn path_of(&self, name: &str) -> String {
        let other = self.other_paths.get(name).cloned();
        other.unwrap_or_else(|| join(&self.folder, name))
    }

    /// Returns the folder of a task file, or the file's path if the file has a different name.
    fn place_of(&self, name: &str) -> String {
        let other = self.other_paths.get(name);
        other.unwrap_or(&self.folder).clone()
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

/// Returns the position of a folder in the assignment's list of folders. A listed folder may be at
/// the top level or inside a top-level folder. Other folders come last.
fn rank(folder: &str, handed_out: &HandedOut) -> usize {
    let folders = handed_out.assignment.folders;
    let position = |folder: &str| folders.iter().position(|known| *known == folder);
    let below = folder.split_once('/').map_or("", |(_, below)| below);
    position(folder)
        .or_else(|| Some(folders.len() + position(below)?))
        .unwrap_or(2 * folders.len())
}

/// Returns the folder of a file.
fn parent(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
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
