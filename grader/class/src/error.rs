//! The error that stops the grading of a class, and its exit code.

use grader::error::Error as GraderError;
use grader::files::PathError;

/// An error that stops the grading of a class.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The user can fix it: the command line, the input or a list is wrong.
    #[error("{0}")]
    User(String),
    /// The machine is at fault: the output folder cannot be used, or submissions cannot be isolated.
    #[error("{0}")]
    Machine(String),
    /// The grader cannot be set up, because of the exam, the compiler or the dependencies.
    #[error(transparent)]
    Grader(GraderError),
}

impl Error {
    /// Returns an error that the user can fix, with another error's message.
    pub fn user(error: impl ToString) -> Self {
        Error::User(error.to_string())
    }

    /// Returns 2 if the user can fix the error, and 3 if the grader or the machine is at fault.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::User(_) => 2,
            Error::Machine(_) => 3,
            Error::Grader(error) => error.exit_code(),
        }
    }
}

impl From<PathError> for Error {
    fn from(error: PathError) -> Self {
        Error::Machine(error.to_string())
    }
}

impl From<GraderError> for Error {
    fn from(error: GraderError) -> Self {
        if let GraderError::Isolation(error) = error {
            let remedy = "if you trust the submissions, use --isolation none";
            return Error::Machine(format!("{error}; {remedy}"));
        }
        Error::Grader(error)
    }
}
