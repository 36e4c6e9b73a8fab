//! Everything that a command finds before it grades a submission, each found once.

use std::time::Instant;

use super::resolve::{builder, collect, source_paths};
use crate::build::Builder;
use crate::error::Error;
use crate::grade::options::GradeOptions;
use crate::submission::Submission;
use crate::workspace::Workspace;
use crate::workspace::source_paths::SourcePaths;

/// A submission, and the workspace and the builder that it is graded with.
pub struct Prepared<'a> {
    /// The options that name the submission.
    pub options: &'a GradeOptions,
    /// The workspace.
    pub workspace: Workspace,
    /// The submission's files.
    pub submission: Submission,
    /// The builder, once it is needed.
    builder: Option<Builder>,
    /// The time at which the command started.
    pub(super) started_at: Instant,
}

impl<'a> Prepared<'a> {
    /// Finds the workspace, and reads the submission that the options name.
    pub fn new(options: &'a GradeOptions) -> Result<Self, Error> {
        let started_at = Instant::now();
        let workspace = Workspace::find()?;
        Ok(Prepared {
            submission: collect(options, &workspace)?,
            options,
            workspace,
            builder: None,
            started_at,
        })
    }

    /// Returns the builder without a sandbox. It is prepared at the first call.
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
