//! The task files of a solution: the reference's files, possibly with changes.

use std::path::Path;

use grader::files::{self, PathError};
use grader::handed_out::{HandedOut, TaskFile};
use grader::submission::Submission;

/// The task files of a solution to an assignment, in lecture order.
#[derive(Clone, Debug)]
pub struct Sources {
    handed_out: &'static HandedOut,
    files: Vec<(TaskFile, String)>,
    /// The crates that the files may use in addition to the crates allowed for submissions.
    crates: Vec<String>,
}

impl Sources {
    /// Reads the files of an assignment's reference in the workspace at `root`.
    pub fn reference(root: &Path, handed_out: &'static HandedOut) -> Result<Self, PathError> {
        let folder = root.join(handed_out.reference);
        let text = |file: &TaskFile| Ok((*file, files::read_to_string(folder.join(file.name))?));
        let files: Result<_, _> = handed_out.files.iter().map(text).collect();
        Ok(Sources {
            handed_out,
            files: files?,
            crates: Vec::new(),
        })
    }

    /// Returns the assignment that the files solve.
    pub fn handed_out(&self) -> &'static HandedOut {
        self.handed_out
    }

    /// Returns the text of one of the files.
    pub fn text(&self, name: &str) -> Option<&str> {
        let mut files = self.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == name)?;
        Some(text)
    }

    /// Replaces the text of one file.
    pub fn with_file(mut self, name: &str, text: String) -> Self {
        for (file, old) in &mut self.files {
            if file.name == name {
                old.clone_from(&text);
            }
        }
        self
    }

    /// Writes the files to a folder, which is created if it doesn't exist.
    pub fn write(&self, folder: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        let mut files = self.files.iter();
        files.try_for_each(|(file, text)| std::fs::write(folder.join(file.name), text))
    }

    /// Allows these crates in addition to those that submissions may use.
    pub fn with_crates(self, crates: &[String]) -> Self {
        let crates = crates.to_vec();
        Sources { crates, ..self }
    }

    /// Returns the crates that the files may use in addition to the crates allowed for submissions.
    pub fn crates(&self) -> &[String] {
        &self.crates
    }

    /// Converts the files to a submission for the grader.
    pub fn to_submission(&self, name: &str) -> Submission {
        let files = self.files.iter();
        Submission {
            handed_out: self.handed_out,
            name: name.to_owned(),
            files: files
                .map(|(file, text)| (*file, Ok(text.clone())))
                .collect(),
            ignored_copies: Vec::new(),
            notes: Vec::new(),
        }
    }
}
