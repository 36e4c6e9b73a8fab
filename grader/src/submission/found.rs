//! Sorts the files of one folder, on disk or in an archive, by what their names resemble.

use super::choice::{Candidate, FileContents, Lookalike, is_starter, join};
use super::names::{Resemblance, may_be_task_file, resemblance};
use super::{SubmissionFiles, TaskFileError};
use crate::handed_out::HandedOut;

/// The files of a folder, of which some have been read.
pub(super) struct FoundFolder {
    /// The path of the folder below the submission, with `/`. Empty for its top level.
    pub(super) path: String,
    /// The files that may be task files or given files, by name.
    pub(super) read: Vec<(String, FileContents)>,
    /// The names of the other files.
    pub(super) others: Vec<String>,
}

/// Returns whether the contents of a file with this name are needed.
pub(super) fn is_read(name: &str, handed_out: &HandedOut) -> bool {
    handed_out.given_file(name).is_some() || may_be_task_file(name, handed_out)
}

impl FoundFolder {
    /// Returns a folder in which nothing was found yet.
    pub(super) fn new(path: String) -> Self {
        FoundFolder {
            path,
            read: Vec::new(),
            others: Vec::new(),
        }
    }

    /// Returns the folder as one that could be graded, if it has task files, and the files that only
    /// resemble task files.
    pub(super) fn sort(self, handed_out: &HandedOut) -> (Option<Candidate>, Vec<Lookalike>) {
        let mut files = SubmissionFiles::default();
        let mut lookalikes = Vec::new();
        for file in handed_out.file_names() {
            let resembles = |(name, contents): &(String, FileContents)| {
                let kind = resemblance(name, file)?;
                // A folder or a link is no copy.
                let is_copy = !matches!(contents, Err(TaskFileError::NotRegular(_)));
                (kind == Resemblance::Exact || is_copy).then(|| Lookalike {
                    path: join(&self.path, name),
                    file,
                    is_copy: kind == Resemblance::Copy,
                    is_exact: kind == Resemblance::Exact,
                    contents: contents.clone(),
                })
            };
            let mut all: Vec<Lookalike> = self.read.iter().filter_map(resembles).collect();
            if let Some(index) = graded(&all, handed_out) {
                files
                    .task_files
                    .insert(file, all.remove(index).contents.map_err(|why| why.of(file)));
            }
            lookalikes.extend(all);
        }
        if files.task_files.is_empty() {
            return (None, lookalikes);
        }
        let given = self
            .read
            .into_iter()
            .filter(|(name, _)| handed_out.given_file(name).is_some());
        let given = given.map(|(name, contents)| (name, contents.unwrap_or_default()));
        let others = self.others.into_iter().filter(|name| name.ends_with(".rs"));
        let others = others.map(|name| (name, Vec::new()));
        files.other_files = given.chain(others).collect();
        let candidate = Candidate {
            folder: self.path,
            files,
        };
        (Some(candidate), lookalikes)
    }
}

/// Returns the index of the file that counts as the task file: the one with its name, or else a copy
/// of it, if only one file could be meant.
fn graded(all: &[Lookalike], handed_out: &HandedOut) -> Option<usize> {
    if let Some(index) = all.iter().position(|file| file.is_exact) {
        return Some(index);
    }
    let written = all
        .iter()
        .filter(|file| !is_starter(file.file, &file.contents, handed_out));
    let mut written: Vec<&FileContents> = written.map(|file| &file.contents).collect();
    written.dedup();
    let is_meant = |file: &Lookalike| {
        file.is_copy && written.first().is_none_or(|text| **text == file.contents)
    };
    match written.len() {
        0 | 1 => all
            .iter()
            .position(is_meant)
            .or_else(|| all.iter().position(|file| file.is_copy)),
        _ => None,
    }
}
