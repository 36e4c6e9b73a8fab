//! Finds the files and settings that the command line refers to.

use std::path::PathBuf;
use std::time::Duration;

use crate::build::{BuildError, Builder};
use crate::cli::Arguments;
use crate::error::Error;
use crate::policy::{Lateness, Policy, PolicyError, SubmissionTime, SubmissionTimeError};
use crate::probe::Budget;
use crate::submission::Submission;
use crate::workspace::Workspace;
use judging::exam::Exam;
use judging::sanitize::safe_folder_name;

/// Returns the policy that the command line names, or the default.
pub(super) fn policy(arguments: &Arguments, exam: &Exam) -> Result<Policy, PolicyError> {
    let Some(path) = &arguments.policy else {
        return Ok(Policy::default());
    };
    let policy = Policy::read(path)?;
    policy.check(path, exam)?;
    Ok(policy)
}

/// Returns how late the submission is, if the command line names the platform's metadata.
pub(super) fn lateness(
    arguments: &Arguments,
    policy: &Policy,
) -> Result<Lateness, SubmissionTimeError> {
    let submission_time = arguments
        .gradescope_metadata
        .as_deref()
        .map(SubmissionTime::read);
    let lateness =
        submission_time.map(|read| read.map(|submission_time| policy.lateness_of(submission_time)));
    lateness.unwrap_or(Ok(Lateness::NONE))
}

/// Returns the default folder for a submission's score.
pub fn default_folder(workspace: &Workspace, submission: &Submission) -> PathBuf {
    workspace
        .output_folder()
        .join(safe_folder_name(&submission.name))
}

/// Returns the builder. It uses the reference's parts if they exist, unless `--no-reference` is
/// set.
pub fn builder(arguments: &Arguments, workspace: &Workspace) -> Result<Builder, BuildError> {
    let builder = Builder::prepare(workspace)?;
    match workspace.reference() {
        Some(reference) if !arguments.no_reference => builder.with_reference(&reference, workspace),
        Some(_) | None => Ok(builder),
    }
}

/// Reads the submission that the command line names.
pub fn collect(arguments: &Arguments, workspace: &Workspace) -> Result<Submission, Error> {
    Ok(Submission::collect(&submission_path(arguments, workspace))?)
}

/// Returns the path of the submission that the command line names.
pub(super) fn submission_path(arguments: &Arguments, workspace: &Workspace) -> PathBuf {
    match &arguments.submission {
        Some(path) => workspace.resolve(path),
        None => workspace.student(),
    }
}

/// Returns the time budget of an item.
pub fn budget(arguments: &Arguments) -> Budget {
    Budget {
        cpu: Duration::from_secs(arguments.cpu_limit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_leads_out_of_the_output_folder_or_into_the_caches() {
        let workspace = Workspace::find().unwrap();
        // These include `...zip` without its extension, and the name of the cache folder.
        for name in ["..", ".", "", "../..", "/etc", ".cache", "a/b"] {
            let submission = Submission {
                name: name.to_owned(),
                files: Vec::new(),
                notes: Vec::new(),
            };
            let folder = default_folder(&workspace, &submission);
            let parent = folder.parent().unwrap();
            assert_eq!(parent, workspace.output_folder(), "{name}");
            assert_ne!(folder, workspace.cache_folder(), "{name}");
        }
    }
}
