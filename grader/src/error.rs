//! Errors that prevent grading, and their exit codes.

use std::io;

use crate::build::BuildError;
use crate::exam_source::ExamSourceError;
use crate::files::PathError;
use crate::format::outputs::OutputError;
use crate::policy::{PolicyError, SubmissionTimeError};
use crate::select_isolation::IsolationError;
use crate::submission::SubmissionError;
use crate::workspace::WorkspaceError;

/// An error that prevents grading.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The submission cannot be found or read.
    #[error(transparent)]
    Submission(#[from] SubmissionError),
    /// The exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
    /// The policy cannot be used.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// The submission time cannot be read.
    #[error(transparent)]
    SubmissionTime(#[from] SubmissionTimeError),
    /// An output format cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The question to replay does not exist.
    #[error("{0}")]
    Replay(String),
    /// More points are required than there are.
    #[error("--require {points} cannot be met: the assignment has {most} points")]
    RequiredPoints {
        /// The required points.
        points: u32,
        /// The points of the assignment.
        most: u32,
    },
    /// The workspace cannot be found.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// The compiler cannot be found, or the dependencies cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The required isolation is not available.
    #[error(transparent)]
    Isolation(#[from] IsolationError),
    /// A file of the report cannot be written.
    #[error(transparent)]
    File(#[from] PathError),
    /// A probe cannot be built or started.
    #[error("cannot run the submission's program: {0}")]
    Probe(#[from] io::Error),
}

impl Error {
    /// Returns 2 for errors that the user can fix, and 3 for errors of the grader or the machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Submission(error) if error.is_machine_fault() => 3,
            Error::Submission(_)
            | Error::Exam(_)
            | Error::Policy(_)
            | Error::Output(OutputError::MissingVariable { .. })
            | Error::Replay(_)
            | Error::RequiredPoints { .. } => 2,
            Error::Workspace(_)
            | Error::SubmissionTime(_)
            | Error::Build(_)
            | Error::Output(OutputError::File(_))
            | Error::Isolation(_)
            | Error::File(_)
            | Error::Probe(_) => 3,
        }
    }
}
