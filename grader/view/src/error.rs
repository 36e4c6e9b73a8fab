//! Errors that prevent viewing, and their exit codes.

use std::io;

use framework::scene::SceneError;
use grader::build::BuildError;
use grader::exam_source::ExamSourceError;
use grader::files::PathError;
use grader::nearest_name::suggestion;
use grader::select_isolation::IsolationError;
use grader::submission::SubmissionError;
use grader::workspace::WorkspaceError;

/// An error that prevents viewing.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The workspace cannot be found.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// The submission cannot be found or read.
    #[error(transparent)]
    Submission(#[from] SubmissionError),
    /// The reference is not on this machine.
    #[error("there is no reference here: leave out --reference")]
    NoReference,
    /// The compiler cannot be found, or the dependencies cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The required isolation is not available.
    #[error(transparent)]
    Isolation(#[from] IsolationError),
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
    /// The practice exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
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
            ViewError::Workspace(_)
            | ViewError::Build(_)
            | ViewError::Isolation(_)
            | ViewError::Exam(_)
            | ViewError::Listen(_)
            | ViewError::File(_)
            | ViewError::Random(_) => 3,
        }
    }
}
