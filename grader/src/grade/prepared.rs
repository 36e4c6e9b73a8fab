//! Everything a command prepares before it grades a submission: the files and settings that the
//! options refer to.

use std::path::PathBuf;
use std::time::Instant;

use judging::exam::Exam;
use judging::sanitize::safe_folder_name;

use crate::build::Builder;
use crate::error::Error;
use crate::grade::options::{Dependents, GradeOptions};
use crate::handed_out::HandedOut;
use crate::policy::{Lateness, Policy, SubmissionTime};
use crate::submission::Submission;
use crate::workspace::Workspace;
use crate::workspace::source_paths::SourcePaths;

/// A submission together with the workspace and the builder used to grade it.
pub struct PreparedSubmission<'a> {
    /// The options that name the submission.
    pub options: &'a GradeOptions,
    /// The workspace.
    pub workspace: Workspace,
    /// The submission's files.
    pub submission: Submission,
    /// The builder, or `None` until it is needed.
    builder: Option<Builder>,
    /// The time when the command started.
    pub(super) started_at: Instant,
}

impl<'a> PreparedSubmission<'a> {
    /// Finds the workspace and reads the submission named in the options.
    pub fn new(options: &'a GradeOptions) -> Result<Self, Error> {
        let started_at = Instant::now();
        let workspace = Workspace::find()?;
        Ok(PreparedSubmission {
            submission: collect(options, &workspace)?,
            options,
            workspace,
            builder: None,
            started_at,
        })
    }

    /// Returns the builder, preparing it on the first call. It doesn't have a sandbox yet.
    pub fn builder(&mut self) -> Result<&Builder, Error> {
        let builder = match self.builder.take() {
            Some(builder) => builder,
            None => builder(self.options, &self.workspace)?,
        };
        Ok(self.builder.insert(builder))
    }

    /// Returns the paths of the submission's task files.
    pub fn source_paths(&self) -> SourcePaths {
        source_paths(self.options, &self.workspace)
    }
}

/// Returns the policy named in the options, or the default.
pub(super) fn policy(options: &GradeOptions, exam: &Exam) -> Result<Policy, Error> {
    let Some(path) = &options.policy else {
        return Ok(Policy::default());
    };
    let items = exam.items.iter().map(|item| item.id.as_str());
    Policy::for_exam(path, &Policy::read_text(path)?, items)
}

/// Returns the lateness of the submission if the options name the platform's metadata.
pub(super) fn lateness(options: &GradeOptions, policy: &Policy) -> Result<Lateness, Error> {
    Ok(match &options.gradescope_metadata {
        Some(path) => policy.lateness_of(&SubmissionTime::read(path)?),
        None => Lateness::NONE,
    })
}

/// Returns the default folder for a submission's score. The score of any assignment other than the
/// default is in a subfolder, since a submission may contain both.
pub fn default_folder(workspace: &Workspace, submission: &Submission) -> PathBuf {
    let folder = workspace.output_folder();
    let folder = folder.join(safe_folder_name(&submission.name));
    if submission.handed_out == <&HandedOut>::default() {
        folder
    } else {
        folder.join(submission.handed_out.assignment.id)
    }
}

/// Prepares a builder that uses the reference's parts if they exist and the options allow it.
pub(super) fn builder(options: &GradeOptions, workspace: &Workspace) -> Result<Builder, Error> {
    let builder = Builder::prepare(workspace)?;
    match workspace.reference(options.handed_out) {
        Some(reference) if options.dependents == Dependents::SubstituteReference => {
            builder.with_reference(&reference, options.handed_out, workspace)
        }
        Some(_) | None => Ok(builder),
    }
}

/// Reads the submission named in the options.
pub(super) fn collect(options: &GradeOptions, workspace: &Workspace) -> Result<Submission, Error> {
    let path = submission_path(options, workspace);
    Ok(match &options.submission {
        Some(_) => Submission::collect(&path, options.handed_out)?,
        None => Submission::collect_package(&path, options.handed_out)?,
    })
}

/// Returns the path of the submission named in the options.
pub(super) fn submission_path(options: &GradeOptions, workspace: &Workspace) -> PathBuf {
    match &options.submission {
        Some(path) => workspace.resolve(path),
        None => workspace.root().join(options.handed_out.student),
    }
}

/// Returns the paths of the task files in the submission named in the options.
pub(super) fn source_paths(options: &GradeOptions, workspace: &Workspace) -> SourcePaths {
    SourcePaths::of(&submission_path(options, workspace), options.handed_out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    #[test]
    fn no_name_leads_out_of_the_output_folder_or_into_the_caches() {
        let workspace = Workspace::find().unwrap();
        // These include `...zip` without its extension, and the name of the cache folder.
        for name in ["..", ".", "", "../..", "/etc", ".cache", "a/b"] {
            let submission = Submission {
                handed_out: &RAYS,
                name: name.to_owned(),
                files: Vec::new(),
                ignored_copies: Vec::new(),
                notes: Vec::new(),
            };
            let folder = default_folder(&workspace, &submission);
            let parent = folder.parent().unwrap();
            assert_eq!(parent, workspace.output_folder(), "{name}");
            assert_ne!(folder, workspace.cache_folder(), "{name}");
        }
    }
}
