//! What learning platforms and build servers read: each format a pure function of what students
//! may see. None is handed the score itself, so none can leak what the policy hides.

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

use crate::exam::Task;
use crate::report::html;
use crate::report::text::{HintDetail, report};

pub use student_view::{ItemView, StudentView};

/// A format, by the platform that reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// The score file, for staff: it is written in any case.
    Json,
    /// The report that is read on a terminal.
    Text,
    /// A page, for students of an exam that they do not have.
    Html,
    /// Gradescope's `results.json`.
    Gradescope,
    /// classroom50's `result.json`.
    Classroom50,
    /// JUnit's XML: a suite for each task.
    Junit,
    /// A summary in Markdown; annotations go to standard output.
    Github,
    /// The step output that GitHub Classroom's reporter read.
    GithubClassroom,
    /// check50's JSON.
    Check50,
    /// PrairieLearn's `results.json`.
    Prairielearn,
}

/// A format, and where it goes if not to its usual place: `gradescope`, `github=summary.md`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputSpec {
    /// Which.
    pub format: Format,
    /// Where.
    pub path: Option<PathBuf>,
}

/// What is around a submission, and no part of its score.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormatContext {
    /// The folder of the five files, as its repository names it: `student/src`. Empty at the top.
    pub folder: String,
    /// The line where each task's method begins in its file.
    pub method_lines: BTreeMap<Task, u32>,
    /// What the platform says of the submission.
    pub variables: BTreeMap<&'static str, String>,
    /// How much is said of recognised mistakes.
    pub full_hints: bool,
}

impl Format {
    /// The file's name, where no platform says otherwise.
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

    /// What the platform tells by variables, and this format repeats.
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

    /// The file's text. None for the score file, which is no matter of what students see.
    pub fn render(self, seen: &StudentView, around: &FormatContext) -> Option<String> {
        Some(match self {
            Format::Json => return None,
            Format::Text => terminal_report(seen, around),
            Format::Html => html::feedback(&seen.visible),
            Format::Gradescope => gradescope::render(seen, around),
            Format::Classroom50 => classroom50::render(seen, around),
            Format::Junit => junit::render(seen, around),
            Format::Github => github::summary(seen, around),
            Format::GithubClassroom => github_classroom::render(seen, around),
            Format::Check50 => check50::render(seen, around),
            Format::Prairielearn => prairielearn::render(seen, around),
        })
    }
}

/// The report on a terminal, without colours.
fn terminal_report(seen: &StudentView, around: &FormatContext) -> String {
    let hints = match around.full_hints {
        true => HintDetail::Full,
        false => HintDetail::Nudge,
    };
    let report = report(&seen.visible, None, hints);
    let mut text = anstream::adapter::strip_str(&report).to_string();
    if let Some(unfinished) = seen.unfinished_notice() {
        text.push_str(&format!("  {unfinished}\n"));
    }
    text
}

/// A value as JSON, with a line end.
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
                "the formats are {}, each with =PATH if it shall go there",
                known.join(", ")
            )
        })?;
        match path {
            Some(path) if format == Format::Json || path.as_os_str().is_empty() => {
                Err("a path is meant, and score.json goes to --out".to_owned())
            }
            path => Ok(OutputSpec { format, path }),
        }
    }
}

impl Format {
    /// What the command line calls it.
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
