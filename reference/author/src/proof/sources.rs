//! The five files of a submission that is made here: the reference's, some of them changed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::given::{TASK_FILES, TaskFile};
use grader::submission::Submission;

/// A file of this repository can not be read.
#[derive(Debug, thiserror::Error)]
#[error("can not read {}: {source}", path.display())]
pub struct Unreadable {
    /// Which.
    pub path: PathBuf,
    /// What the system says.
    pub source: io::Error,
}

/// The text of a file.
pub fn read(path: &Path) -> Result<String, Unreadable> {
    fs::read_to_string(path).map_err(|source| Unreadable {
        path: path.to_owned(),
        source,
    })
}

/// Five files, in lecture order.
#[derive(Clone, Debug)]
pub struct Sources {
    files: Vec<(TaskFile, String)>,
}

impl Sources {
    /// The reference's, of the workspace at `root`.
    pub fn reference(root: &Path) -> Result<Self, Unreadable> {
        let text = |file: TaskFile| Ok((file, read(&root.join("reference/src").join(file.name))?));
        let files: Result<_, _> = TASK_FILES.into_iter().map(text).collect();
        Ok(Sources { files: files? })
    }

    /// The text of one of the five.
    pub fn text(&self, name: &str) -> Option<&str> {
        let mut files = self.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == name)?;
        Some(text)
    }

    /// With another text in the place of one file's.
    pub fn with(mut self, name: &str, text: String) -> Self {
        for (file, old) in &mut self.files {
            if file.name == name {
                old.clone_from(&text);
            }
        }
        self
    }

    /// As the grader takes it.
    pub fn submission(&self, name: &str) -> Submission {
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
