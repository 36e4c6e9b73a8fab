//! What the command line names, found.

use std::path::PathBuf;
use std::time::Duration;

use crate::build::{BuildError, Builder};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam::Exam;
use crate::policy::{Lateness, Policy, PolicyError, SubmissionTime, SubmissionTimeError};
use crate::probe::Budget;
use crate::submission::Submission;
use crate::workspace::Workspace;

/// The policy that the command line names, or the default.
pub(super) fn policy(arguments: &Arguments, exam: &Exam) -> Result<Policy, PolicyError> {
    let Some(path) = &arguments.policy else {
        return Ok(Policy::default());
    };
    let policy = Policy::read(path)?;
    policy.check(path, exam)?;
    Ok(policy)
}

/// How late the submission is, where a platform says so.
pub(super) fn lateness(
    arguments: &Arguments,
    policy: &Policy,
) -> Result<Lateness, SubmissionTimeError> {
    let handed_in = arguments
        .gradescope_metadata
        .as_deref()
        .map(SubmissionTime::read);
    let lateness = handed_in.map(|read| read.map(|handed_in| policy.lateness_of(handed_in)));
    lateness.unwrap_or(Ok(Lateness::NONE))
}

/// Where a score goes unless told otherwise.
pub fn default_folder(workspace: &Workspace, submission: &Submission) -> PathBuf {
    workspace.output_folder().join(&submission.name)
}

/// What submissions are built with: with the reference, where it is at hand and not declined.
pub fn builder(arguments: &Arguments, workspace: &Workspace) -> Result<Builder, BuildError> {
    let builder = Builder::prepare(workspace)?;
    match workspace.reference() {
        Some(reference) if !arguments.no_reference => builder.with_reference(&reference, workspace),
        Some(_) | None => Ok(builder),
    }
}

/// The submission that the command line names.
pub fn collect(arguments: &Arguments, workspace: &Workspace) -> Result<Submission, Error> {
    Ok(Submission::collect(&submission_path(arguments, workspace))?)
}

/// Where it lies.
pub(super) fn submission_path(arguments: &Arguments, workspace: &Workspace) -> PathBuf {
    match &arguments.submission {
        Some(path) => workspace.resolve(path),
        None => workspace.student(),
    }
}

/// What an item may use.
pub fn budget(arguments: &Arguments) -> Budget {
    Budget {
        cpu: Duration::from_secs(arguments.cpu_limit),
    }
}
