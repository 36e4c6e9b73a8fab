//! Errors that prevent viewing, and their exit codes.

use std::fmt::Display;

/// An error that prevents viewing, with its message.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// An error that the user can fix.
    #[error("{0}")]
    Usage(String),
    /// An error caused by the viewer or the machine.
    #[error("{0}")]
    Machine(String),
}

impl ViewError {
    /// Wraps an error that the user can fix.
    pub fn usage(error: impl Display) -> Self {
        ViewError::Usage(error.to_string())
    }

    /// Wraps an error caused by the viewer or the machine.
    pub fn machine(error: impl Display) -> Self {
        ViewError::Machine(error.to_string())
    }

    /// Returns the exit code of the program.
    pub fn exit_code(&self) -> u8 {
        match self {
            ViewError::Usage(_) => 2,
            ViewError::Machine(_) => 3,
        }
    }
}
