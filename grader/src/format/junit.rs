//! JUnit's XML: a suite for each task, a case for each item.
//!
//! Written with `maud`, which escapes as XML wants it: a crate for JUnit brings seven others along,
//! a tenth of the first `cargo grade`. Every element is closed by hand, with `{}`: there are no void
//! elements in XML.

use maud::{Markup, PreEscaped, html};

use crate::format::item_text::{item_message, item_text};
use crate::format::{FormatContext, StudentView};
use crate::score::{ItemScore, TaskScore, Verdict};

const DECLARATION: PreEscaped<&str> = PreEscaped("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");

/// The whole file.
pub fn render(seen: &StudentView, around: &FormatContext) -> String {
    let score = &seen.visible;
    let all: Counts = score.items().collect();
    let report = html! {
        (DECLARATION)
        testsuites name={ "pathtracing, " (score.exam.id) " exam" } tests=(all.tests)
            skipped=(all.skipped) failures=(all.failures) errors=(all.errors) {
            @for task in &score.tasks {
                (suite(seen, task, around))
            }
        }
        "\n"
    };
    report.into_string().chars().filter(is_xml_char).collect()
}

fn suite(seen: &StudentView, task: &TaskScore, around: &FormatContext) -> Markup {
    let own: Counts = task.items.iter().collect();
    html! {
        testsuite name=(task.id.id()) tests=(own.tests)
            skipped=(own.skipped) errors=(own.errors) failures=(own.failures) {
            properties {
                (property("title", &task.title))
                (property("complete", &seen.visible.complete.to_string()))
                (points_properties(task.points, task.max_points))
            }
            @for item in &task.items {
                testcase name=(item.id) classname=(task.id.id()) {
                    properties {
                        (property("title", &item.title))
                        (points_properties(item.points, item.max_points))
                    }
                    (status_element(seen, item, around))
                }
            }
            @if let Some(printed) = &task.printed {
                system-out { (printed) }
            }
        }
    }
}

fn property(name: &str, value: &str) -> Markup {
    html! { property name=(name) value=(value) {} }
}

fn points_properties(points: u32, max_points: u32) -> Markup {
    html! {
        (property("points", &points.to_string()))
        (property("max_points", &max_points.to_string()))
    }
}

fn status_element(seen: &StudentView, item: &ItemScore, around: &FormatContext) -> Markup {
    let (message, kind) = (item_message(item), item.verdict.label());
    let said = item_text(seen, item, around);
    match Status::from_verdict(&item.verdict) {
        Status::Passed => html! {},
        Status::Failed => html! { failure message=(message) type=(kind) { (said) } },
        Status::Error => html! { error message=(message) type=(kind) { (said) } },
        Status::Skipped => html! { skipped message=(message) type=(kind) { (said) } },
    }
}

/// What JUnit tells apart.
enum Status {
    Passed,
    Failed,
    Error,
    Skipped,
}

impl Status {
    /// A wrong answer is a failure; none at all is an error; what was not asked is skipped.
    fn from_verdict(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Pass => Status::Passed,
            Verdict::Partial | Verdict::Wrong | Verdict::Panicked | Verdict::Unimplemented => {
                Status::Failed
            }
            Verdict::TimedOut
            | Verdict::OutOfMemory
            | Verdict::Crashed
            | Verdict::Protocol
            | Verdict::NotCompiled => Status::Error,
            Verdict::Blocked { .. } | Verdict::Pending => Status::Skipped,
        }
    }
}

/// How many there are of each.
#[derive(Default)]
struct Counts {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
}

impl<'a> FromIterator<&'a ItemScore> for Counts {
    fn from_iter<I: IntoIterator<Item = &'a ItemScore>>(items: I) -> Self {
        let mut counts = Counts::default();
        for item in items {
            counts.tests += 1;
            match Status::from_verdict(&item.verdict) {
                Status::Passed => {}
                Status::Failed => counts.failures += 1,
                Status::Error => counts.errors += 1,
                Status::Skipped => counts.skipped += 1,
            }
        }
        counts
    }
}

/// No XML may hold any other, not even escaped.
fn is_xml_char(character: &char) -> bool {
    matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}
