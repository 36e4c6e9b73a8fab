//! Renders the section of a task, and the section about the submitted files.

use maud::{Markup, html};

use super::Page;
use super::elements::plain_text;
use super::item;
use crate::report::failing_items::most_telling_first;
use crate::score::{ItemScore, Score, TaskScore};

/// Renders the files that did not compile, and the notes. Returns nothing if there are neither.
pub(super) fn files(score: &Score) -> Markup {
    let build = &score.build;
    if build.not_compiled.is_empty() && build.all_notes().next().is_none() {
        return html! {};
    }
    html! {
        section aria-labelledby="files" {
            h2 #files { "Your files" }
            @for file in &build.not_compiled {
                h3 { code { (plain_text(&file.file)) } " was not used" }
                pre { (plain_text(&file.message)) }
            }
            @if build.all_notes().next().is_some() {
                ul .notes {
                    @for note in build.all_notes() { li { (plain_text(note)) } }
                }
            }
        }
    }
}

/// Renders one task: failing items first, then the printed output, then the passed items.
pub(super) fn section(page: &Page, task: &TaskScore) -> Markup {
    let failing = most_telling_first(task);
    let is_passed = |item: &&ItemScore| item.points == item.max_points;
    let passed: Vec<&ItemScore> = task.items.iter().filter(is_passed).collect();
    html! {
        section aria-labelledby=(task.id) {
            h2 #(task.id) {
                (task.title)
                span .points { " " (task.points) " / " (task.max_points) }
            }
            @for (index, score) in failing.iter().enumerate() {
                // The first is enough to start with.
                (item::failing(page, score, index == 0))
            }
            @if let Some(printed) = &task.printed {
                details #(format!("{}-printed", task.id)) .printed {
                    summary { "What your code printed" }
                    pre { (plain_text(printed)) }
                }
            }
            @if !passed.is_empty() {
                details #(format!("{}-passed", task.id)) .passed {
                    summary { "✓ " (passed.len()) " passed" }
                    ul {
                        @for score in &passed {
                            li { (item::passed(page, score)) }
                        }
                    }
                }
            }
        }
    }
}
