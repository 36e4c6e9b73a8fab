//! The submissions of a trial, and the points that they must get.

use std::fs;
use std::path::Path;

use grader::files::{self, AtPath};
use grader::handed_out::HandedOut;

use crate::package::trial::{TrialError, thief};

/// A submission of a trial, by its contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrialSubmission {
    /// The reference solution.
    Reference,
    /// The unchanged starter.
    Starter,
    /// A submission without any of the five task files.
    Empty,
    /// Task files that try to steal solutions and keys: see [`thief`].
    Thief,
}

impl TrialSubmission {
    /// Returns the name of the submission for messages.
    pub fn description(self) -> &'static str {
        match self {
            TrialSubmission::Reference => "the reference",
            TrialSubmission::Starter => "the starter",
            TrialSubmission::Empty => "an empty submission",
            TrialSubmission::Thief => "an attacking submission",
        }
    }

    /// Returns the points that the submission must get.
    pub fn points(self) -> u64 {
        match self {
            TrialSubmission::Reference => 100,
            TrialSubmission::Starter | TrialSubmission::Empty | TrialSubmission::Thief => 0,
        }
    }

    /// Writes the submission's files into a folder, which is emptied first.
    pub fn write_to(
        self,
        handed_out: &HandedOut,
        workspace: &Path,
        folder: &Path,
    ) -> Result<(), TrialError> {
        if folder.exists() {
            fs::remove_dir_all(folder).at("remove", folder)?;
        }
        files::create_dir_all(folder)?;
        let from = match self {
            TrialSubmission::Reference => workspace.join(handed_out.reference),
            TrialSubmission::Starter => workspace.join(handed_out.starter),
            TrialSubmission::Empty => return Ok(()),
            TrialSubmission::Thief => {
                for (file, text) in thief::files(handed_out, workspace)? {
                    files::write(folder.join(file), text)?;
                }
                return Ok(());
            }
        };
        for file in handed_out.files {
            files::copy(from.join(file.name), folder.join(file.name))?;
        }
        Ok(())
    }
}
