//! The layouts that the input can have, and their names.

use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};

/// A layout of the input, named after the platform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// Gradescope's "Export submissions"
    Gradescope,
    /// Canvas's "Download submissions"
    Canvas,
    /// Moodle's "Download all submissions"
    Moodle,
    /// Blackboard's "Assignment file download"
    Blackboard,
    /// Brightspace's (D2L's) "Download all files"
    Brightspace,
    /// Sakai's "Download all"
    Sakai,
    /// Submitted files of a class in Microsoft Teams
    Teams,
    /// Clones of repositories from GitHub Classroom or classroom50
    #[value(name = "github", alias = "classroom50")]
    GitHub,
    /// Clones of a GitLab group's projects, or a folder per tutorial that contains a folder per student
    /// (alias: `tutorials`)
    #[value(name = "gitlab", alias = "tutorials")]
    GitLab,
    /// A folder or archive for each student
    #[default]
    #[value(name = "folders")]
    Plain,
}

/// How to read the input if its names don't make that clear. The choice is stored in `run.json`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, Args)]
pub struct LayoutChoice {
    /// Layout of the input; default: the last run's layout, or the one detected from file and
    /// folder names
    #[arg(long, value_name = "PLATFORM")]
    pub layout: Option<Layout>,

    /// Title of the assignment to grade, if the input contains several (e.g. from Microsoft Teams);
    /// default: the last run's title
    #[arg(long, value_name = "TITLE")]
    pub title: Option<String>,
}

impl LayoutChoice {
    /// Returns this choice, with missing parts taken from the last run's choice.
    #[must_use]
    pub fn or(&self, last: &LayoutChoice) -> Self {
        LayoutChoice {
            layout: self.layout.or(last.layout),
            title: self.title.as_ref().or(last.title.as_ref()).cloned(),
        }
    }
}

impl Layout {
    /// Returns the name that is used on the command line.
    pub fn name(self) -> String {
        let value = self.to_possible_value().expect("no layout is hidden");
        value.get_name().to_owned()
    }
}
