//! What can go wrong that is no student's fault, and whose it is.

use std::io;
use std::path::PathBuf;

use crate::build::BuildError;
use crate::doctor::package::PackageError;
use crate::exam_file::ExamError;
use crate::format::outputs::OutputError;
use crate::policy::{PolicyError, SubmissionTimeError};
use crate::select_isolation::IsolationError;
use crate::submission::SubmissionError;
use crate::workspace::WorkspaceError;

/// Why there is no score.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The submission's place.
    #[error(transparent)]
    Submission(#[from] SubmissionError),
    /// The exam.
    #[error(transparent)]
    Exam(#[from] ExamError),
    /// The policy.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// When it was handed in.
    #[error(transparent)]
    SubmissionTime(#[from] SubmissionTimeError),
    /// A platform's package.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// What platforms read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// What to replay.
    #[error("{0}")]
    Replay(String),
    /// The project's place.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// The compiler or what it needs.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The submission can not be kept apart as it should.
    #[error(transparent)]
    Isolation(#[from] IsolationError),
    /// A report can not be written.
    #[error("can not write {path}: {source}")]
    Report {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// A probe can not be started, or made.
    #[error("can not run the submission's program: {0}")]
    Probe(#[from] io::Error),
}

impl Error {
    /// 2 where whoever typed the command can mend it, 3 where it is our fault or the machine's.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Submission(_)
            | Error::Exam(_)
            | Error::Policy(_)
            | Error::Package(_)
            | Error::Output(OutputError::MissingVariable { .. })
            | Error::Replay(_) => 2,
            Error::Workspace(_)
            | Error::SubmissionTime(_)
            | Error::Build(_)
            | Error::Output(OutputError::Io { .. })
            | Error::Isolation(_)
            | Error::Report { .. }
            | Error::Probe(_) => 3,
        }
    }
}
