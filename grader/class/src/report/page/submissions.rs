//! The table of all submissions.

use grader::workspace::book::percent_encoded;
use maud::{Markup, html};

use super::{header, sanitized, section, wide};
use crate::graded_class::{ClassRow, GradedClass};
use crate::report::grades::LATE;

pub(super) fn submissions(class: &GradedClass) -> Markup {
    let tasks = class.tasks();
    let of = class.counts_max().map(|most| format!(" (of {most})"));
    let counts = format!("Counts{}", of.unwrap_or_default());
    let numbers = [counts.as_str(), "Points"].into_iter();
    let numbers = numbers.chain(tasks.iter().map(|task| task.title.as_str()));
    let table = html! { table .sortable {
        (header(&["Who"], numbers.map(sanitized), "Notes"))
        tbody {
            @for row in &class.rows { (submission_row(row, tasks.len())) }
            @for person in &class.missing { tr {
                th scope="row" { (sanitized(&class.distinct_name(person))) }
                td .number { "–" }
                td .number { "–" }
                @for _ in tasks { td {} }
                td { "nothing submitted" }
            } }
        }
    } };
    section("students", "Submissions", &wide("students", &table))
}

fn submission_row(row: &ClassRow, tasks: usize) -> Markup {
    let names = row.result.info.display_names();
    let is_other = names != row.result.id;
    // Names may be equal or look alike.
    let id = html! { @if is_other { " " code { (sanitized(&row.result.id)) } } };
    let who = sanitized(&names);
    html! {
        tr {
            @if let Some(score) = row.result.score() {
                th scope="row" { a href=(report_link(&row.result.id)) { (who) } (id) }
                td .number { strong { (counts(row)) } }
                td .number { (score.points) }
                @for task in &score.tasks {
                    td .number .less[task.points < task.max_points] { (task.points) }
                }
            } @else {
                th scope="row" { (who) (id) }
                td .number { (counts(row)) }
                td .number { "–" }
                @for _ in 0..tasks { td {} }
            }
            td { (notes(row)) }
        }
    }
}

/// Returns each person's final points, or a single number if they are all equal.
fn counts(row: &ClassRow) -> String {
    let counts = row.grades.iter().map(|grade| match &grade.counted {
        Some(counted) => counted.points.to_string(),
        None => "–".to_owned(),
    });
    let mut counts: Vec<String> = counts.collect();
    counts.dedup();
    counts.join(" / ")
}

/// Renders the platform's late flag, an explanation of the final points (or the reason there are
/// none), and comments by staff.
fn notes(row: &ClassRow) -> Markup {
    html! {
        @if row.result.info.is_late() { p { "marked " (LATE) " by the platform" } }
        @for text in &row.notes() { p { (sanitized(text)) } }
    }
}

/// Returns the link to a report. An id may contain letters from any language, which are
/// percent-encoded.
pub(super) fn report_link(id: &str) -> String {
    format!("students/{}/report.html", percent_encoded(id))
}
