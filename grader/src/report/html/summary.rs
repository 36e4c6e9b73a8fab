//! Renders the top of the page: the points and what to do next.

use maud::{Markup, html};

use super::Page;
use super::counted;
use super::elements::{command, plain_text, prose};
use super::pictures;
use super::steps::step;
use crate::inputs::exam_source::PRACTICE_ID;
use crate::report::failing_items::in_order_to_fix;
use crate::sandbox::Isolation;
use crate::score::rerun_command::RerunCommand;
use crate::score::{ItemScore, Score, TaskScore, Verdict, VerdictKind};
use crate::svg::number;

/// Renders the submission's name, the exam and the points per task.
pub(super) fn header(score: &Score) -> Markup {
    html! {
        header {
            @if !score.assignment_title.is_empty() { p .assignment { (score.assignment_title) } }
            h1 { span .untrusted { (plain_text(&score.submission)) } }
            p .total {
                strong { (score.points) " of " (score.max_points) }
                " points, " (plain_text(&score.exam.id)) " exam"
                @if score.isolation > Isolation::None {
                    ", isolation: " (score.isolation.name())
                }
            }
            (counted::marks())
            @if !score.complete {
                p .unfinished {
                    strong { "Not finished." }
                    " This page was written while grading was still running. If grading has \
                     since stopped, the items marked “" (Verdict::Pending.label()) "” were never \
                     graded."
                }
            }
            table .points {
                caption { "Points per task" }
                thead {
                    tr {
                        th scope="col" { "Task" }
                        th scope="col" .wide { "Share" }
                        th scope="col" .number { "Points" }
                        th scope="col" .number .items { "Items passed" }
                    }
                }
                tbody {
                    @for task in &score.tasks { (row(task)) }
                }
            }
        }
    }
}

fn row(task: &TaskScore) -> Markup {
    let passed = task
        .items
        .iter()
        .filter(|item| item.verdict == Verdict::Pass);
    html! {
        tr {
            th scope="row" { a href=(format!("#{}", task.id)) { (task.title) } }
            td .wide { (bar(task)) }
            td .number { (task.points) " / " (task.max_points) }
            td .number .items { (passed.count()) " / " (task.items.len()) }
        }
    }
}

/// Renders a bar for the points of a task. It is hidden from screen readers, since the numbers next
/// to it say the same thing.
fn bar(task: &TaskScore) -> Markup {
    let width = 100.0 * f64::from(task.points) / f64::from(task.max_points.max(1));
    html! {
        svg .bar viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true" {
            rect .all width="100" height="10" {}
            rect .some width=(number(width)) height="10" {}
        }
    }
}

/// Renders the next step, which is to fix the first failing item in lecture order. The steps for the
/// other failing items are hidden. If the first item is removed from the exam after grading, the
/// finished page can show one of them instead.
pub(super) fn next_step(page: &Page) -> Markup {
    let failing = in_order_to_fix(page.score);
    html! {
        section aria-labelledby="next" {
            h2 #next { "What to do next" }
            @for (index, item) in failing.iter().enumerate() {
                (step(&item.id, index == 0, &first_failure(item, page.rerun)))
            }
            @if failing.is_empty() {
                (all_passed(page.score))
                (pictures::beside_the_references(page.exam, page.answers))
            } @else {
                @let done = html! { p { "Nothing: your code passes everything that counts." } };
                (step("", false, &done))
            }
        }
    }
}

fn all_passed(score: &Score) -> Markup {
    html! {
        p {
            "Nothing: your code passes everything that this exam tests."
            @if score.exam.id == PRACTICE_ID {
                " The final exam asks the same kinds of questions with different numbers."
            }
        }
    }
}

fn first_failure(item: &ItemScore, rerun: Option<&RerunCommand>) -> Markup {
    let link = format!("#{}", item.id);
    html! {
        p {
            a href=(link) { (plain_text(&item.title)) }
            " (" code { (plain_text(&item.id)) } ")"
        }
        @match item.verdict.kind() {
            VerdictKind::Pending => p { "This item has not been graded yet." },
            VerdictKind::Unwritten => p { "Write this method first: " (plain_text(&item.message)) "." },
            VerdictKind::NotCompiled => {
                p { "Fix the file first: " (plain_text(&item.message)) ". " a href="#files" { "See the compiler’s message" } }
            },
            VerdictKind::Passed | VerdictKind::Failed | VerdictKind::NoAnswer
            | VerdictKind::Blocked => p { (plain_text(&item.message)) },
        }
        @if let Some(look) = item.where_to_look() {
            p { (prose(look)) }
        }
        @for hint in &item.hints { p { (prose(&hint.nudge)) } }
        @if let Some(rerun) = rerun {
            p .rerun { "Run it again: " (command(&item.rerun_command(rerun))) }
        }
    }
}
