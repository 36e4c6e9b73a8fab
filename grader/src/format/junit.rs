//! JUnit XML with a suite for each task and a test case for each item.
//!
//! The file is written with `maud`, whose escaped text is valid XML. A crate for JUnit would bring
//! in seven other crates and lengthen the compile time of the first `cargo grade` by a tenth. Every
//! element is closed explicitly with `{}`, since XML has no void elements.

use maud::{Markup, PreEscaped, html};

use crate::format::item_text::{item_message, item_text};
use crate::format::{FormatContext, FormatSpec, StudentView};
use crate::score::{ItemScore, TaskScore, Verdict, VerdictKind};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "junit",
    file: "junit.xml",
    render: Some(render),
    ..FormatSpec::EMPTY
};

const DECLARATION: PreEscaped<&str> = PreEscaped("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");

/// Renders the XML file.
fn render(view: &StudentView, context: &FormatContext) -> String {
    let score = &view.visible;
    let all = || score.items();
    let report = html! {
        (DECLARATION)
        testsuites name={ "pathtracing, " (score.exam.id) " exam" } tests=(all().count())
            skipped=(count(all(), Status::Skipped)) failures=(count(all(), Status::Failed))
            errors=(count(all(), Status::Error)) {
            @for task in &score.tasks {
                (suite(view, task, context))
            }
        }
        "\n"
    };
    report.into_string().chars().filter(is_xml_char).collect()
}

fn suite(view: &StudentView, task: &TaskScore, context: &FormatContext) -> Markup {
    let own = || task.items.iter();
    html! {
        testsuite name=(task.id.id()) tests=(task.items.len())
            skipped=(count(own(), Status::Skipped)) errors=(count(own(), Status::Error))
            failures=(count(own(), Status::Failed)) {
            properties {
                (property("title", &task.title))
                (property("complete", &view.visible.complete.to_string()))
                (points_properties(task.points, task.max_points))
                @if let Some(counted) = view.counted_text() {
                    (property("counted", &counted))
                }
            }
            @for item in &task.items {
                testcase name=(item.id) classname=(task.id.id()) {
                    properties {
                        (property("title", &item.title))
                        (points_properties(item.points, item.max_points))
                    }
                    (status_element(view, item, context))
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

fn status_element(view: &StudentView, item: &ItemScore, context: &FormatContext) -> Markup {
    let (message, kind) = (item_message(item), item.verdict.label());
    let text = item_text(view, item, context);
    match Status::from_verdict(&item.verdict) {
        Status::Passed => html! {},
        Status::Failed => html! { failure message=(message) type=(kind) { (text) } },
        Status::Error => html! { error message=(message) type=(kind) { (text) } },
        Status::Skipped => html! { skipped message=(message) type=(kind) { (text) } },
    }
}

/// Returns the number of items with this result.
fn count<'a>(items: impl Iterator<Item = &'a ItemScore>, status: Status) -> usize {
    let has_status = |item: &&ItemScore| Status::from_verdict(&item.verdict) == status;
    items.filter(has_status).count()
}

/// The result of a test case in JUnit.
#[derive(PartialEq, Eq)]
enum Status {
    Passed,
    Failed,
    Error,
    Skipped,
}

impl Status {
    /// Returns the result for a verdict. A wrong answer becomes a failure, a missing answer becomes
    /// an error, and an item that was not graded becomes a skipped test case.
    fn from_verdict(verdict: &Verdict) -> Self {
        match verdict.kind() {
            VerdictKind::Passed => Status::Passed,
            VerdictKind::Failed | VerdictKind::Unwritten => Status::Failed,
            VerdictKind::NoAnswer | VerdictKind::NotCompiled => Status::Error,
            VerdictKind::Blocked | VerdictKind::Pending => Status::Skipped,
        }
    }
}

/// Returns whether XML allows the character. Other characters are invalid even when escaped.
fn is_xml_char(character: &char) -> bool {
    matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

#[cfg(test)]
mod tests {
    use super::is_xml_char;

    #[test]
    fn characters_that_xml_forbids_are_left_out() {
        assert!("a\t\r\n é\u{fffd}😀".chars().all(|c| is_xml_char(&c)));
        let mut others = "\0\u{7}\u{1b}\u{fffe}\u{ffff}".chars();
        assert!(!others.any(|c| is_xml_char(&c)));
    }
}
