//! What is handed in to a package that is tried, and what has to come of it.

use std::fs;
use std::path::Path;

use grader::given_files::TASK_FILES;

use crate::package::trial::{TrialError, io_error, thief};

/// A submission, by what is in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrialSubmission {
    /// The solution.
    Reference,
    /// What students begin with.
    Starter,
    /// None of the five files.
    Empty,
    /// Five files that steal.
    Thief,
}

impl TrialSubmission {
    /// Whose it is, for people.
    pub fn description(self) -> &'static str {
        match self {
            TrialSubmission::Reference => "the reference",
            TrialSubmission::Starter => "the starter",
            TrialSubmission::Empty => "an empty submission",
            TrialSubmission::Thief => "a submission that steals",
        }
    }

    /// What it is worth.
    pub fn points(self) -> u64 {
        match self {
            TrialSubmission::Reference => 100,
            TrialSubmission::Starter | TrialSubmission::Empty | TrialSubmission::Thief => 0,
        }
    }

    /// Puts its files into a new folder, and nothing else.
    pub fn write_to(self, workspace: &Path, folder: &Path) -> Result<(), TrialError> {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(io_error(folder))?;
        }
        fs::create_dir_all(folder).map_err(io_error(folder))?;
        let from = match self {
            TrialSubmission::Reference => workspace.join("reference/src"),
            TrialSubmission::Starter => workspace.join("grader/starter"),
            TrialSubmission::Empty => return Ok(()),
            TrialSubmission::Thief => {
                for (file, text) in thief::files(workspace)? {
                    fs::write(folder.join(file), text).map_err(io_error(folder))?;
                }
                return Ok(());
            }
        };
        for file in TASK_FILES {
            let from = from.join(file.name);
            fs::copy(&from, folder.join(file.name)).map_err(io_error(&from))?;
        }
        Ok(())
    }
}
