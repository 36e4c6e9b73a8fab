//! Errors that prevent viewing, and their exit codes.

use std::io;

use framework::scene::SceneError;
use grader::error::Error;
use grader::files::PathError;
use grader::nearest_name::suggestion;
use grader::submission::SubmissionError;

/// An error that prevents viewing.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The workspace, the compiler, the exam or the required isolation cannot be used.
    #[error(transparent)]
    Grader(#[from] Error),
    /// The submission cannot be found or read.
    #[error(transparent)]
    Submission(#[from] SubmissionError),
    /// The reference is not on this machine.
    #[error("there is no reference here: leave out --reference")]
    NoReference,
    /// There is no scene with this name.
    #[error(
        "there is no scene `{name}`{}; the folder `scenes` contains: {}",
        suggestion(.name, .known.iter().map(String::as_str)),
        .known.join(", ")
    )]
    UnknownScene {
        /// The name.
        name: String,
        /// The names of all scenes.
        known: Vec<String>,
    },
    /// A scene file is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The question does not exist, or shows nothing.
    #[error("{0}")]
    Question(String),
    /// Another program uses the port.
    #[error("port {port} is in use: choose another one with --port, or leave out --port")]
    PortInUse {
        /// The port.
        port: u16,
    },
    /// The server cannot be started.
    #[error("cannot listen on 127.0.0.1: {0}")]
    Listen(io::Error),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] PathError),
    /// The system provides no random numbers.
    #[error("the system provides no random numbers: {0}")]
    Random(#[from] getrandom::Error),
}

impl ViewError {
    /// Returns 2 for errors that the user can fix, and 3 for errors of the viewer or the machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            ViewError::Submission(_)
            | ViewError::NoReference
            | ViewError::UnknownScene { .. }
            | ViewError::Scene(_)
            | ViewError::Question(_)
            | ViewError::PortInUse { .. } => 2,
            ViewError::Grader(error) => error.exit_code(),
            ViewError::Listen(_) | ViewError::File(_) | ViewError::Random(_) => 3,
        }
    }
}
