//! The sections about differences from earlier runs.

use maud::{Markup, html};

use super::submissions::report_link;
use super::{sanitized, section};
use crate::regrade_diff::{Changes, ScoreChange};
use crate::report::text::{points_now, points_of_item, with_changed_points};
use grader::printing::counted;

/// Renders the differences from earlier runs, if any.
pub(super) fn changes(changes: &Changes) -> Markup {
    let resubmitted = with_changed_points(&changes.resubmitted);
    html! {
        @if let Some(regrade) = &changes.regrade { (section(
            "regraded", "Scores changed by the regrade", &html! {
                @if regrade.causes.is_empty() { p { "No settings changed." } }
                @else { p { "Changed settings: " (regrade.causes.join(", ")) "." } }
                (score_changes(&with_changed_points(&regrade.scores)))
            },
        )) }
        @if let Some(grades) = changes.grades.as_ref().filter(|grades| !grades.is_empty()) { (section(
            "grades", "Changed final grades", &html! {
                @if !grades.causes.is_empty() { p { "Changed: " (grades.causes.join(", ")) "." } }
                @if grades.changes.is_empty() { p { "No final grades changed." } }
                (list(&grades.changes))
            },
        )) }
        @if !resubmitted.is_empty() {
            (section("resubmitted", "Changed submissions", &score_changes(&resubmitted)))
        }
        @if !changes.removed.is_empty() {
            (section("removed", "No longer in the input", &list(&changes.removed)))
        }
    }
}

fn list(texts: &[String]) -> Markup {
    html! { ul { @for text in texts { li { (sanitized(text)) } } } }
}

fn score_changes(changes: &[&ScoreChange]) -> Markup {
    html! {
        @if changes.is_empty() { p { "No scores changed." } }
        ul { @for change in changes { li {
            a href=(report_link(&change.id)) { (sanitized(&change.id)) }
            ": " strong { (change.was) " → " (points_now(change)) }
            @if !change.items.is_empty() { details {
                summary { (counted(change.items.len(), "item")) }
                ul { @for item in &change.items { li {
                    @let [was, now] = points_of_item(item);
                    code { (sanitized(&item.item)) } " " (was) " → " (now) ": " (sanitized(&item.why))
                } } }
            } }
        } } }
    }
}
