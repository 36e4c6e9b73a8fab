//! What is handed in to a package that is tried, and what has to come of it.

use std::fs;
use std::path::Path;

use grader::given::TASK_FILES;

use crate::package::trial::{NotTried, at, thief};

/// A submission, by what is in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandedIn {
    /// The solution.
    Reference,
    /// What students begin with.
    Starter,
    /// None of the five files.
    Nothing,
    /// Five files that steal.
    Thief,
}

impl HandedIn {
    /// Whose it is, for people.
    pub fn words(self) -> &'static str {
        match self {
            HandedIn::Reference => "the reference",
            HandedIn::Starter => "the starter",
            HandedIn::Nothing => "an empty submission",
            HandedIn::Thief => "a submission that steals",
        }
    }

    /// What it is worth.
    pub fn points(self) -> u64 {
        match self {
            HandedIn::Reference => 100,
            HandedIn::Starter | HandedIn::Nothing | HandedIn::Thief => 0,
        }
    }

    /// Puts its files into a new folder, and nothing else.
    pub fn lay_out(self, workspace: &Path, folder: &Path) -> Result<(), NotTried> {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(at(folder))?;
        }
        fs::create_dir_all(folder).map_err(at(folder))?;
        let from = match self {
            HandedIn::Reference => workspace.join("reference/src"),
            HandedIn::Starter => workspace.join("grader/starter"),
            HandedIn::Nothing => return Ok(()),
            HandedIn::Thief => {
                for (file, text) in thief::files(workspace)? {
                    fs::write(folder.join(file), text).map_err(at(folder))?;
                }
                return Ok(());
            }
        };
        for file in TASK_FILES {
            let from = from.join(file.name);
            fs::copy(&from, folder.join(file.name)).map_err(at(&from))?;
        }
        Ok(())
    }
}
