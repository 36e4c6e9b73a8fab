//! The five files of a submission that is made here: the reference's, some of them changed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::given_files::{TASK_FILES, TaskFile};
use grader::submission::Submission;

/// A file of this repository can not be read.
#[derive(Debug, thiserror::Error)]
#[error("can not read {}: {source}", path.display())]
pub struct ReadError {
    /// Which.
    pub path: PathBuf,
    /// What the system says.
    pub source: io::Error,
}

/// The text of a file.
pub fn read(path: &Path) -> Result<String, ReadError> {
    fs::read_to_string(path).map_err(|source| ReadError {
        path: path.to_owned(),
        source,
    })
}

/// Five files, in lecture order.
#[derive(Clone, Debug)]
pub struct Sources {
    files: Vec<(TaskFile, String)>,
    /// What they name that submissions may not.
    crates: Vec<String>,
}

impl Sources {
    /// The reference's, of the workspace at `root`.
    pub fn reference(root: &Path) -> Result<Self, ReadError> {
        let text = |file: TaskFile| Ok((file, read(&root.join("reference/src").join(file.name))?));
        let files: Result<_, _> = TASK_FILES.into_iter().map(text).collect();
        Ok(Sources {
            files: files?,
            crates: Vec::new(),
        })
    }

    /// The text of one of the five.
    pub fn text(&self, name: &str) -> Option<&str> {
        let mut files = self.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == name)?;
        Some(text)
    }

    /// With another text in the place of one file's.
    pub fn with_file(mut self, name: &str, text: String) -> Self {
        for (file, old) in &mut self.files {
            if file.name == name {
                old.clone_from(&text);
            }
        }
        self
    }

    /// With these crates at hand, beside those of every submission.
    pub fn with_crates(self, crates: &[String]) -> Self {
        let crates = crates.to_vec();
        Sources { crates, ..self }
    }

    /// The crates that they name, beside those of every submission.
    pub fn crates(&self) -> &[String] {
        &self.crates
    }

    /// As the grader takes it.
    pub fn to_submission(&self, name: &str) -> Submission {
        let files = self.files.iter();
        Submission {
            name: name.to_owned(),
            files: files
                .map(|(file, text)| (*file, Ok(text.clone())))
                .collect(),
            notes: Vec::new(),
        }
    }
}
