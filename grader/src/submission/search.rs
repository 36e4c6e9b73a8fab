//! The results of searching a submission's folders and archives. The files of each folder are
//! classified by what their names resemble.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::candidate::{Candidate, FileContents, Lookalike, is_starter, join};
use super::limit::Limit;
use super::limited_reader::ByteBudget;
use super::names::{Resemblance, may_be_task_file, resemblance};
use super::{SubmissionError, TaskFileError};
use crate::handed_out::HandedOut;

/// The contents of a submission.
#[derive(Debug)]
pub(super) struct Search {
    /// The path of the submission, for use in messages.
    pub(super) submission: PathBuf,
    /// The assignment.
    pub(super) handed_out: &'static HandedOut,
    /// The amount of each limited quantity that has been read so far.
    counts: BTreeMap<Limit, usize>,
    /// The bytes that may still be read from archives.
    pub(super) bytes: ByteBudget,
    /// The folders that contain task files, on disk or in an archive.
    pub(super) candidates: Vec<Candidate>,
    /// The files that only resemble task files.
    pub(super) lookalikes: Vec<Lookalike>,
    /// The names at the top level, with invalid UTF-8 replaced.
    pub(super) names: Vec<String>,
    /// The paths of links below the folder, with `/` as the separator.
    pub(super) links: Vec<String>,
    /// The paths of folders and archives that cannot be read or are nested too deeply, each with
    /// the error.
    pub(super) errors: Vec<(String, SubmissionError)>,
    /// Notes about files that were handed in again under the same name.
    pub(super) superseded: Vec<String>,
    /// The archives that were found, with their paths on disk.
    pub(super) archives: Vec<(String, PathBuf)>,
}

/// The files of a folder, some of which have been read.
#[derive(Default)]
pub(super) struct FoundFolder {
    /// The path of the folder below the submission, with `/` as the separator. Empty for the
    /// submission's top level.
    pub(super) path: String,
    /// The names and contents of the files that may be task files or given files.
    pub(super) read: Vec<(String, FileContents)>,
    /// The names of the other files.
    pub(super) others: Vec<String>,
}

impl Search {
    /// Returns a search that has found nothing yet.
    pub(super) fn new(submission: &Path, handed_out: &'static HandedOut) -> Self {
        Search {
            submission: submission.to_owned(),
            handed_out,
            counts: BTreeMap::new(),
            bytes: ByteBudget::new(Limit::Bytes.most() as u64),
            candidates: Vec::new(),
            lookalikes: Vec::new(),
            names: Vec::new(),
            links: Vec::new(),
            errors: Vec::new(),
            superseded: Vec::new(),
            archives: Vec::new(),
        }
    }

    /// Adds to the count of a limited quantity. Fails if the count then exceeds the limit.
    pub(super) fn spend(&mut self, limit: Limit, count: usize) -> Result<(), SubmissionError> {
        let spent = self.counts.entry(limit).or_default();
        *spent = spent.saturating_add(count);
        if *spent > limit.most() {
            Err(self.too_many(limit))
        } else {
            Ok(())
        }
    }

    /// Fails if too many bytes have been read from archives.
    pub(super) fn check_bytes(&self) -> Result<(), SubmissionError> {
        if self.bytes.is_exhausted() {
            Err(self.too_many(Limit::Bytes))
        } else {
            Ok(())
        }
    }

    /// Returns the error to report if a limit is exceeded.
    pub(super) fn too_many(&self, limit: Limit) -> SubmissionError {
        SubmissionError::TooMany(self.submission.clone(), limit)
    }

    /// Returns whether the contents of a file with this name are needed.
    pub(super) fn is_read(&self, name: &str) -> bool {
        self.handed_out.given_file(name).is_some() || may_be_task_file(name, self.handed_out)
    }

    /// Adds a folder on disk or in an archive. If it contains task files, it becomes a candidate
    /// for grading. Files that only resemble task files are recorded too.
    pub(super) fn add_folder(&mut self, folder: FoundFolder) -> Result<(), SubmissionError> {
        let FoundFolder { path, read, others } = folder;
        let handed_out = self.handed_out;
        let (mut task_files, mut other_paths) = (BTreeMap::new(), BTreeMap::new());
        for file in handed_out.file_names() {
            let resembles = |(name, contents): &(String, FileContents)| {
                let kind = resemblance(name, file)?;
                // A folder or a link isn't a copy.
                let is_copy = *contents != Err(TaskFileError::NotRegular);
                (kind == Resemblance::Exact || is_copy).then(|| Lookalike {
                    path: join(&path, name),
                    file,
                    kind,
                    contents: contents.clone(),
                })
            };
            let mut all: Vec<Lookalike> = read.iter().filter_map(resembles).collect();
            if let Some(index) = graded(&all, handed_out) {
                let graded = all.remove(index);
                task_files.insert(file, graded.contents);
                if graded.kind != Resemblance::Exact {
                    other_paths.insert(file, graded.path);
                }
            }
            self.lookalikes.extend(all);
        }
        if task_files.is_empty() {
            return Ok(());
        }
        self.spend(Limit::Folders, 1)?;
        let given = read
            .into_iter()
            .filter(|(name, _)| handed_out.given_file(name).is_some());
        let given = given.map(|(name, contents)| (name, contents.unwrap_or_default()));
        let others = others.into_iter().filter(|name| name.ends_with(".rs"));
        let others = others.map(|name| (name, Vec::new()));
        self.candidates.push(Candidate {
            folder: path,
            task_files,
            other_paths,
            other_files: given.chain(others).collect(),
        });
        Ok(())
    }

    /// Records an error in one folder or archive, so that the search can continue. Fails if the
    /// submission exceeds a limit.
    pub(super) fn keep_error<T>(
        &mut self,
        path: &str,
        found: Result<T, SubmissionError>,
    ) -> Result<(), SubmissionError> {
        match found {
            Err(error @ SubmissionError::TooMany(_, limit)) if limit != Limit::Levels => Err(error),
            Err(error) => {
                self.errors.push((path.to_owned(), error));
                Ok(())
            }
            Ok(_) => Ok(()),
        }
    }
}

/// Returns the index of the file to use as the task file: the file with the exact name or, failing
/// that, the copy of it, if there is only one.
fn graded(all: &[Lookalike], handed_out: &HandedOut) -> Option<usize> {
    let of_kind = |kind: Resemblance| all.iter().position(|file| file.kind == kind);
    if let Some(index) = of_kind(Resemblance::Exact) {
        return Some(index);
    }
    let written = all
        .iter()
        .filter(|file| !is_starter(file.file, &file.contents, handed_out));
    let mut written: Vec<&FileContents> = written.map(|file| &file.contents).collect();
    written.dedup();
    let is_meant = |file: &Lookalike| {
        let is_only_one = written.first().is_none_or(|text| **text == file.contents);
        file.kind == Resemblance::Copy && is_only_one
    };
    match written.len() {
        0 | 1 => all
            .iter()
            .position(is_meant)
            .or_else(|| of_kind(Resemblance::Copy)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    #[test]
    fn as_many_as_the_limit_are_read() {
        for (limit, most, refusal) in [
            (Limit::Files, 50_000, "files and folders (more than 50000)"),
            (Limit::Archives, 32, "archives (more than 32)"),
            (Limit::Folders, 64, "folders with task files (more than 64)"),
            (Limit::Copies, 200, "copies of task files (more than 200)"),
        ] {
            let mut search = Search::new("ann".as_ref(), &RAYS);
            assert!(search.spend(limit, most).is_ok());
            assert!(search.spend(limit, 0).is_ok());
            let refused = search.spend(limit, 1).unwrap_err().to_string();
            let end = ": hand in only the task files";
            assert_eq!(refused, format!("ann contains too many {refusal}{end}"));
            assert!(search.check_bytes().is_ok());
        }
        let bytes = "too much data in its archives (more than 1024 MiB)";
        assert_eq!(Limit::Bytes.to_string(), bytes);
        let levels = "too many levels of nested folders";
        assert_eq!(Limit::Levels.to_string(), levels);
    }
}
