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

use super::candidate::{Candidate, FileContents, Lookalike, is_starter};
use super::names::Resemblance;
use super::{MAX_NOTES, SubmissionError, display_name};
use crate::handed_out::HandedOut;

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
                return Err(conflict(path, [first, candidate], name, handed_out));
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

/// Returns the error to report when there are differing copies of these task files.
fn ambiguous(path: &Path, files: &[&str], copies: Vec<&str>) -> SubmissionError {
    SubmissionError::Ambiguous {
        path: path.to_owned(),
        files: files.iter().map(|file| display_name(file)).collect(),
        copies: copies.into_iter().map(display_name).collect(),
    }
}

/// Returns the error to report when two folders contain different versions of a task file. It
/// also names any other files that differ between the same two folders.
fn conflict(
    path: &Path,
    [first, other]: [&Candidate; 2],
    name: &str,
    handed_out: &HandedOut,
) -> SubmissionError {
    let places = |name: &str| [first.place_of(name), other.place_of(name)];
    let differs = |(file, contents): &(&'static str, &FileContents)| {
        let own = first.written(handed_out).find(|(own, _)| own == file);
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

#[cfg(test)]
mod tests;
