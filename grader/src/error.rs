//! What can go wrong that is no student's fault, and whose it is.

use std::io;
use std::path::PathBuf;

use crate::build::BuildError;
use crate::doctor::package::NoPackage;
use crate::exam_file::BadExam;
use crate::format::outputs::NoOutput;
use crate::isolate::NotIsolated;
use crate::policy::{NoMoments, PolicyError};
use crate::submission::NoSubmission;
use crate::workspace::NoWorkspace;

/// Why there is no score.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The submission's place.
    #[error(transparent)]
    Submission(#[from] NoSubmission),
    /// The exam.
    #[error(transparent)]
    Exam(#[from] BadExam),
    /// The policy.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// When it was handed in.
    #[error(transparent)]
    HandedIn(#[from] NoMoments),
    /// A platform's package.
    #[error(transparent)]
    Package(#[from] NoPackage),
    /// What platforms read.
    #[error(transparent)]
    Output(#[from] NoOutput),
    /// What to replay.
    #[error("{0}")]
    Replay(String),
    /// The project's place.
    #[error(transparent)]
    Workspace(#[from] NoWorkspace),
    /// The compiler or what it needs.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The submission can not be kept apart as it should.
    #[error(transparent)]
    Isolation(#[from] NotIsolated),
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
            | Error::Output(NoOutput::Variable { .. })
            | Error::Replay(_) => 2,
            Error::Workspace(_)
            | Error::HandedIn(_)
            | Error::Build(_)
            | Error::Output(NoOutput::Io { .. })
            | Error::Isolation(_)
            | Error::Report { .. }
            | Error::Probe(_) => 3,
        }
    }
}
