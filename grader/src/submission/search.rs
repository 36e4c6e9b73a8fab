//! The results of a search in the folders and archives of a submission.

use std::path::{Path, PathBuf};

use super::SubmissionError;
use super::budget::{Budget, Limit};
use super::choice::{Candidate, Lookalike};
use super::found::FoundFolder;
use crate::handed_out::HandedOut;

/// The contents of a submission.
#[derive(Debug)]
pub(super) struct Search {
    /// The path of the submission, for messages.
    pub(super) submission: PathBuf,
    /// The rest of the budget.
    pub(super) budget: Budget,
    /// The folders that have task files, on disk or in an archive.
    pub(super) candidates: Vec<Candidate>,
    /// The files that only resemble task files.
    pub(super) lookalikes: Vec<Lookalike>,
    /// The names at the top level, in which what is not UTF-8 is replaced.
    pub(super) names: Vec<String>,
    /// The paths of links below the folder, with `/`.
    pub(super) links: Vec<String>,
    /// Folders and archives that cannot be read, or are below too many others, by their paths.
    pub(super) errors: Vec<(String, SubmissionError)>,
    /// The archives that were found, with their paths on disk.
    pub(super) archives: Vec<(String, PathBuf)>,
}

impl Search {
    /// Returns a search that has found nothing yet.
    pub(super) fn new(submission: &Path) -> Self {
        Search {
            submission: submission.to_owned(),
            budget: Budget::default(),
            candidates: Vec::new(),
            lookalikes: Vec::new(),
            names: Vec::new(),
            links: Vec::new(),
            errors: Vec::new(),
            archives: Vec::new(),
        }
    }

    /// Deducts a number of things from the budget.
    pub(super) fn spend(&self, limit: Limit, count: usize) -> Result<(), SubmissionError> {
        self.too_many(self.budget.spend(limit, count))
    }

    /// Fails if too many bytes have been read from archives.
    pub(super) fn check_bytes(&self) -> Result<(), SubmissionError> {
        self.too_many(self.budget.check_bytes())
    }

    fn too_many(&self, spent: Result<(), Limit>) -> Result<(), SubmissionError> {
        spent.map_err(|limit| SubmissionError::TooMany(self.submission.clone(), limit))
    }

    /// Adds a folder, on disk or in an archive, if it has task files or copies of them.
    pub(super) fn add_folder(
        &mut self,
        folder: FoundFolder,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let (candidate, lookalikes) = folder.sort(handed_out);
        self.spend(Limit::Folders, usize::from(candidate.is_some()))?;
        self.candidates.extend(candidate);
        self.lookalikes.extend(lookalikes);
        Ok(())
    }

    /// Records the error of one folder or archive, so that the search can go on. Fails if there is
    /// too much to be read at all.
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
