//! Output formats for learning platforms and CI services. Each renderer is a pure function of a
//! [`StudentView`] and a [`FormatContext`] and never gets the score itself, so no format can leak
//! what the policy hides.

mod check50;
mod classroom50;
pub mod github;
mod github_classroom;
mod gradescope;
mod item_text;
mod junit;
pub mod outputs;
mod prairielearn;
mod size;
mod student_view;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;

use clap::ValueEnum;
use judging::exam::Task;

use crate::report::html;
use crate::report::text::{HintDetail, report};

pub use student_view::{ItemView, StudentView};

/// An output format, named after the platform that reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// The score file, for staff. It is always written.
    Json,
    /// The terminal report.
    Text,
    /// A page for students who do not have the exam.
    Html,
    /// Gradescope's `results.json`.
    Gradescope,
    /// classroom50's `result.json`.
    Classroom50,
    /// JUnit XML with a suite for each task.
    Junit,
    /// A summary in Markdown, with annotations on standard output.
    Github,
    /// The step output for GitHub Classroom's reporter.
    GithubClassroom,
    /// check50's JSON.
    Check50,
    /// PrairieLearn's `results.json`.
    Prairielearn,
}

/// A format and an optional path, such as `gradescope` or `github=summary.md`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputSpec {
    /// The format.
    pub format: Format,
    /// The file to write, or `None` for the format's default file.
    pub path: Option<PathBuf>,
}

/// Facts about a submission that are not part of its score.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormatContext {
    /// The folder of the task files in the repository, such as `student/src`. It is empty if they
    /// are at the top level.
    pub folder: String,
    /// The line where each task's method begins in its file.
    pub method_lines: BTreeMap<Task, u32>,
    /// The environment variables with which the platform describes the submission.
    pub variables: BTreeMap<&'static str, String>,
    /// The level of detail of hints.
    pub hints: HintDetail,
}

impl Format {
    /// Returns the default file name.
    pub fn file(self) -> &'static str {
        match self {
            Format::Json => "score.json",
            Format::Text => "report.txt",
            Format::Html => "feedback.html",
            Format::Gradescope => "gradescope.json",
            Format::Classroom50 => "classroom50.json",
            Format::Junit => "junit.xml",
            Format::Github => "github.md",
            Format::GithubClassroom => "github-classroom.txt",
            Format::Check50 => "check50.json",
            Format::Prairielearn => "prairielearn.json",
        }
    }

    /// Returns the environment variables that this format copies.
    pub fn variables(self) -> &'static [&'static str] {
        match self {
            Format::Classroom50 => &classroom50::VARIABLES,
            Format::Json
            | Format::Text
            | Format::Html
            | Format::Gradescope
            | Format::Junit
            | Format::Github
            | Format::GithubClassroom
            | Format::Check50
            | Format::Prairielearn => &[],
        }
    }

    /// Renders the file. Returns `None` for the score file, which is not for students.
    pub fn render(self, view: &StudentView, context: &FormatContext) -> Option<String> {
        Some(match self {
            Format::Json => return None,
            Format::Text => terminal_report(view, context),
            Format::Html => html::feedback(&view.visible),
            Format::Gradescope => gradescope::render(view, context),
            Format::Classroom50 => classroom50::render(view, context),
            Format::Junit => junit::render(view, context),
            Format::Github => github::summary(view, context),
            Format::GithubClassroom => github_classroom::render(view, context),
            Format::Check50 => check50::render(view, context),
            Format::Prairielearn => prairielearn::render(view, context),
        })
    }
}

/// Renders the terminal report without colours.
fn terminal_report(view: &StudentView, context: &FormatContext) -> String {
    let report = report(&view.visible, None, context.hints);
    let mut text = anstream::adapter::strip_str(&report).to_string();
    if let Some(unfinished) = view.unfinished_notice() {
        text.push_str(&format!("  {unfinished}\n"));
    }
    text
}

/// Returns a value as JSON, with a newline at the end.
fn to_json(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}

impl FromStr for OutputSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, path) = match text.split_once('=') {
            Some((name, path)) => (name, Some(PathBuf::from(path))),
            None => (text, None),
        };
        let format = Format::from_str(name, false).map_err(|_| {
            let known: Vec<&str> = Format::value_variants().iter().map(|f| f.id()).collect();
            format!(
                "the formats are {}; append =PATH to choose the file",
                known.join(", ")
            )
        })?;
        match path {
            Some(path) if format == Format::Json || path.as_os_str().is_empty() => {
                Err("expected a path after `=`; score.json always goes to --out".to_owned())
            }
            path => Ok(OutputSpec { format, path }),
        }
    }
}

impl Format {
    /// Returns the format's name on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Format::Json => "json",
            Format::Text => "text",
            Format::Html => "html",
            Format::Gradescope => "gradescope",
            Format::Classroom50 => "classroom50",
            Format::Junit => "junit",
            Format::Github => "github",
            Format::GithubClassroom => "github-classroom",
            Format::Check50 => "check50",
            Format::Prairielearn => "prairielearn",
        }
    }
}
