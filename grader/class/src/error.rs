//! The error that stops the grading of a class, and its exit code.

use grader::error::Error as GraderError;
use grader::files::PathError;

/// An error that stops the grading of a class.
#[derive(Debug, thiserror::Error)]
#[error("{text}")]
pub struct Error {
    text: String,
    /// 2 if the user can fix the error, and 3 if the grader or the machine is at fault.
    pub exit_code: u8,
}

impl Error {
    /// Returns an error that the user can fix, i.e. one caused by a mistake in the command line,
    /// the input or a list.
    pub fn user(error: impl ToString) -> Self {
        let text = error.to_string();
        Error { text, exit_code: 2 }
    }

    /// Returns an error caused by the machine, e.g. an unusable output folder.
    pub fn machine(error: impl ToString) -> Self {
        let text = error.to_string();
        Error { text, exit_code: 3 }
    }
}

impl From<PathError> for Error {
    fn from(error: PathError) -> Self {
        Error::machine(error)
    }
}

impl From<GraderError> for Error {
    fn from(error: GraderError) -> Self {
        let mut text = error.to_string();
        if let GraderError::Isolation(_) = error {
            text += "; if you trust the submissions, use --isolation none";
        }
        let exit_code = error.exit_code();
        Error { text, exit_code }
    }
}
