//! `report.html`: everything about one score, in one file that loads nothing from the network. The
//! page depends only on the score, the exam and the answers (not on the date, for example).
//!
//! Nothing a submission writes can take over the page: `maud` escapes it, `plain_text` escapes
//! control characters, and the content security policy allows only the page's own script and style,
//! by their hashes.

mod counted;
mod elements;
mod mask;
mod pictures;
mod steps;
mod summary;
mod task;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::inputs::exam_source::PRACTICE_ID;
use crate::report::answers::ReportAnswers;
use crate::score::Score;
use crate::score::rerun_command::RerunCommand;
use crate::workspace::book::Book;

use elements::plain_text;
use judging::exam::Exam;

pub use counted::{with_counted, with_name, without_file_notes, write_counted};
pub use elements::prose;
pub use steps::with_next_step;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
/// Hashes for the content security policy. After a change to `page.css` or `page.js`, a test fails
/// and prints the new hash.
const STYLE_HASH: &str = "sha256-+3DXv2f3kxwFj44iaSVHz40mI21YSqoTcd69bRznM2Q=";
const SCRIPT_HASH: &str = "sha256-0uG7Wc91xj3ZY9h/0tG98u6wzvI6EO25o4C+3n9igjI=";

/// Whether an open page reloads itself to show a newer version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reload {
    /// The page never reloads.
    Never,
    /// The page reloads every 1.5 seconds while its window isn't focused.
    WhileUnfocused,
}

/// The content of a page.
struct Page<'a> {
    score: &'a Score,
    /// The exam, with only the items that readers may see.
    exam: &'a Exam,
    /// The submitted answers.
    answers: &'a ReportAnswers,
    /// The commands for grading again, for readers who can run them.
    rerun: Option<&'a RerunCommand>,
    /// The handout on the reader's machine.
    book: Option<&'a Book>,
}

/// Renders the page for a score. `answers` are the submitted answers to show.
pub fn page(score: &Score, exam: &Exam, answers: &ReportAnswers, reload: Reload) -> String {
    let page = Page {
        score,
        exam,
        answers,
        rerun: Some(&score.rerun_command),
        book: score.book.as_ref(),
    };
    page.render(reload)
}

/// Renders a page for students, which doesn't contain the exam. The page only shows `score`, from
/// which everything that students may not see must already have been removed.
pub fn feedback(score: &Score) -> String {
    let unseen = Exam {
        schema: score.schema,
        assignment: String::new(),
        id: score.exam.id.clone(),
        mistakes: Vec::new(),
        items: Vec::new(),
    };
    let page = Page {
        score,
        exam: &unseen,
        answers: &ReportAnswers::default(),
        rerun: None,
        book: None,
    };
    page.render(Reload::Never)
}

impl Page<'_> {
    fn render(&self, reload: Reload) -> String {
        let score = self.score;
        let title = format!(
            "{}: {} of {} points, {}",
            score.assignment_title, score.points, score.max_points, score.submission
        );
        let title = title.trim_start_matches(": ");
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(content_security_policy());
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    title { (plain_text(title)) }
                    style { (PreEscaped(STYLE)) }
                }
                body data-reload[reload == Reload::WhileUnfocused] {
                    a .skip href="#next" { "Skip to the next step" }
                    (summary::header(score))
                    main {
                        (summary::next_step(self))
                        (task::files(score))
                        @for task in &score.tasks { (task::section(self, task)) }
                    }
                    (self.footer())
                    // The script reports the effects of buttons here, so that screen readers
                    // announce them.
                    p #status .quiet role="status" {}
                    script { (PreEscaped(SCRIPT)) }
                }
            }
        };
        page.into_string()
    }

    fn footer(&self) -> Markup {
        let score = self.score;
        html! {
            footer {
                @if self.rerun.is_some() {
                    p {
                        "Exam " code { (plain_text(&score.exam.id)) } ", "
                        code { (plain_text(score.exam.hash.get(..12).unwrap_or_default())) }
                        @if let Some(version) = &score.bundle {
                            ", version " code { (plain_text(version)) } " of the assignment"
                        }
                        ". "
                        "Programs can read the same data from " code { "score.json" } ", next to this page."
                    }
                    @if score.exam.id != PRACTICE_ID {
                    p {
                        strong { "Not for students:" }
                        " this page shows the exam’s questions and answers. Give students "
                        code { "feedback.html" } " instead, which is written by " code { "cargo class" } " and "
                        code { "cargo grade --format html" } "."
                    }
                    }
                }
            }
        }
    }
}

/// Returns a policy that allows the page's own script and style, embedded images, and nothing else.
fn content_security_policy() -> String {
    format!(
        "default-src 'none'; img-src data:; style-src '{STYLE_HASH}'; script-src '{SCRIPT_HASH}'; \
         base-uri 'none'; form-action 'none'"
    )
}

#[cfg(test)]
mod tests;
