//! The layouts of the input, by name.

use clap::{Args, ValueEnum};

/// A layout of the input, named after the platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
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
    /// Clones of a GitLab group, or a folder for each tutorial with a folder for each student
    #[value(name = "gitlab", alias = "tutorials")]
    GitLab,
    /// A folder or archive for each student
    #[value(name = "folders")]
    Plain,
}

/// How to read the input, where its names do not tell.
#[derive(Clone, Debug, Default, Args)]
pub struct LayoutChoice {
    /// Layout of the input; default: it is recognised by the names of files and folders
    #[arg(long, value_name = "PLATFORM")]
    pub layout: Option<Layout>,

    /// Title of the assignment, if the input has several, as from Microsoft Teams
    #[arg(long, value_name = "TITLE")]
    pub title: Option<String>,
}

impl Layout {
    /// Returns the name on the command line.
    pub fn name(self) -> String {
        let value = self.to_possible_value().expect("no layout is hidden");
        value.get_name().to_owned()
    }
}
