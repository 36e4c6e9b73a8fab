//! The error that ends a command, and its exit code.

use std::io;

use crate::machine::files::PathError;

/// An error that ends a command. Errors that some callers handle specially have their own types,
/// which can be converted to this one.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The user can fix the problem: the command line, the submission, the exam or the policy is
    /// wrong.
    #[error("{0}")]
    User(String),
    /// The grader or the machine is at fault.
    #[error("{0}")]
    Machine(String),
    /// The required isolation isn't available.
    #[error("{0}")]
    Isolation(String),
}

impl Error {
    /// Returns an error that the user can fix.
    pub fn user(message: impl ToString) -> Self {
        Error::User(message.to_string())
    }

    /// Returns an error caused by the grader or the machine.
    pub fn machine(message: impl ToString) -> Self {
        Error::Machine(message.to_string())
    }

    /// Returns 2 for errors that the user can fix, and 3 for errors caused by the grader or the
    /// machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::User(_) => 2,
            Error::Machine(_) | Error::Isolation(_) => 3,
        }
    }
}

impl From<PathError> for Error {
    fn from(error: PathError) -> Self {
        Error::machine(error)
    }
}

/// Converts an error that occurred while a probe was being built or started.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Error::Machine(format!("cannot run the submission's program: {error}"))
    }
}
