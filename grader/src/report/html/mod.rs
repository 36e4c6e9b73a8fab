//! `report.html`: all that there is to see of one score, in one file that asks no network for
//! anything. Pure: what it shows follows from the score, the exam and the answers, and not from
//! the time.
//!
//! Whatever a submission has said is text here: `maud` escapes it, `said` makes it harmless to
//! the eye, and the page's policy runs no script and no style but our own, by their hashes.

mod elements;
mod item;
mod mask;
mod pictures;
mod png;
mod prose;
mod summary;
mod task;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::exam::Exam;
use crate::report_answers::ReportAnswers;
use crate::rerun_command::RerunCommand;
use crate::score::Score;

use elements::plain_text;

/// The exam that students have.
const PRACTICE: &str = "practice";
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
/// Their names in the page's policy, which a test compares with them: who changes one, changes both.
const STYLE_HASH: &str = "sha256-/lbG4HpSq0TpA9Rxa1PxYKdeL7k9uqdzE1cca+RblDk=";
const SCRIPT_HASH: &str = "sha256-0oikulJCHOGL54fs8bQIl7TMm4IEIqSTIjoUg+OJhos=";

/// Whether an open page looks for a newer one in its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reload {
    /// It stays as it is.
    Never,
    /// Every moment, but while its reader is at it.
    WhileUnfocused,
}

/// The page. `exam` is what the score is of; `exhibits` are the answers worth a look.
pub fn page(score: &Score, exam: &Exam, exhibits: &ReportAnswers, reload: Reload) -> String {
    render_page(score, exam, exhibits, Some(&score.rerun_command), reload)
}

/// The page for students of an exam that they do not have: what this score says, which is to be what
/// they may see, and nothing of the exam itself.
pub fn feedback(score: &Score) -> String {
    let unseen = Exam {
        schema: score.schema,
        id: score.exam.id.clone(),
        mistakes: Vec::new(),
        items: Vec::new(),
    };
    render_page(
        score,
        &unseen,
        &ReportAnswers::default(),
        None,
        Reload::Never,
    )
}

/// `again` is how to ask the same once more, for whoever can.
fn render_page(
    score: &Score,
    exam: &Exam,
    exhibits: &ReportAnswers,
    again: Option<&RerunCommand>,
    reload: Reload,
) -> String {
    let title = format!(
        "{}: {} of {} points",
        score.submission, score.points, score.max_points
    );
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(content_security_policy());
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (plain_text(&title)) }
                style { (PreEscaped(STYLE)) }
            }
            body data-reload[reload == Reload::WhileUnfocused] {
                a .skip href="#next" { "Skip to what to do next" }
                (summary::header(score))
                main {
                    (summary::next_step(score, again))
                    (task::files(score))
                    @for task in &score.tasks {
                        (task::section(task, exam, exhibits, again))
                    }
                }
                (footer(score, again))
                // Says to those who listen what a button has done.
                p #said .quiet role="status" {}
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// Nothing from elsewhere, and of scripts and styles only these two.
fn content_security_policy() -> String {
    format!(
        "default-src 'none'; img-src data:; style-src '{STYLE_HASH}'; script-src '{SCRIPT_HASH}'; \
         base-uri 'none'; form-action 'none'"
    )
}

fn footer(score: &Score, again: Option<&RerunCommand>) -> Markup {
    html! {
        footer {
            @if again.is_some() {
                p {
                    "Exam " code { (plain_text(&score.exam.id)) } ", "
                    code { (plain_text(score.exam.hash.get(..12).unwrap_or_default())) } ". "
                    "The same, for programs: " code { "score.json" } " beside this page."
                }
            }
            @if again.is_some() && score.exam.id != PRACTICE {
                p {
                    strong { "Not for students:" }
                    " this page tells the exam’s questions and answers. What they may see is "
                    code { "feedback.html" } ", which " code { "cargo class" } " and "
                    code { "cargo grade --format html" } " write."
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
