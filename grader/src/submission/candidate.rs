//! The folders of a submission that may be graded, and files that only resemble task files.

use std::collections::{BTreeMap, BTreeSet};

use super::names::{Resemblance, is_archive_name};
use super::{TaskFileError, display_name};
use crate::handed_out::{HandedOut, is_unwritten};

/// The bytes of a task file, or the reason there are none.
pub(super) type FileContents = Result<Vec<u8>, TaskFileError>;

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

impl Candidate {
    /// Returns the task files that differ from the starter's.
    pub(super) fn written<'a>(
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
    pub(super) fn differing_files(
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

    /// Returns notes about the files that are graded under a different name.
    pub(super) fn notes_on_names(&self) -> Vec<String> {
        let paths = self.other_paths.iter();
        let renamed = paths.filter(|(name, path)| path.rsplit('/').next() != Some(name));
        let note = |(name, path)| display_name(&format!("{path} is graded as {name}"));
        renamed.map(note).collect()
    }

    /// Returns the files that are changed in this folder but unmodified in `other`. Returns none
    /// unless this folder is in an archive and `other` isn't.
    pub(super) fn archived_copies_of_starter(
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
    pub(super) fn place_of(&self, name: &str) -> String {
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

/// Joins two paths with `/`. Either one may be empty.
pub(super) fn join(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}
