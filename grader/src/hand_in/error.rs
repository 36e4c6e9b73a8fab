//! The reasons why no archive can be made.

use std::path::PathBuf;

use crate::error::Error;

/// The reason why no archive can be made.
#[derive(Debug, thiserror::Error)]
pub enum HandInError {
    /// The path is a file, such as an archive.
    #[error("{0} is a file: name the folder with the task files, such as `student`")]
    NotAFolder(PathBuf),
    /// No task file can be read.
    #[error("no task file in {0} can be read: `cargo grade` says why")]
    NothingReadable(String),
    /// The archive cannot be created in memory.
    #[error("cannot create the archive: {0}")]
    Archive(rawzip::Error),
    /// Reading the archive does not give the files that were written.
    #[error("{0} changed while it was checked, or the disk is damaged: run `cargo handin` again")]
    ReadBack(PathBuf),
    /// The submission cannot be read, compiled or written.
    #[error(transparent)]
    Grader(Error),
}

impl<E: Into<Error>> From<E> for HandInError {
    fn from(error: E) -> Self {
        HandInError::Grader(error.into())
    }
}

impl HandInError {
    /// Returns 2 for errors that the user can fix, and 3 for errors of the grader or the machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            HandInError::NotAFolder(_) | HandInError::NothingReadable(_) => 2,
            HandInError::Archive(_) | HandInError::ReadBack(_) => 3,
            HandInError::Grader(error) => error.exit_code(),
        }
    }
}
