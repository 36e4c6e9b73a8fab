//! The sections about differences from earlier runs.

use maud::{Markup, html};

use super::sanitized;
use super::submissions::report_link;
use crate::regrade_diff::{Changes, Drift};
use crate::report::text::with_changed_points;

/// Renders the differences from earlier runs, if there are any.
pub(super) fn sections(changes: &Changes) -> Markup {
    html! {
        @if let Some(regrade) = &changes.regrade {
            section aria-labelledby="regraded" {
                h2 #regraded { "Scores that the regrade changed" }
                @if regrade.causes.is_empty() { p { "No setting changed." } }
                @else { p { "Changed settings: " (regrade.causes.join(", ")) "." } }
                (drifts(&with_changed_points(&regrade.drifts)))
            }
        }
        @if let Some(grades) = &changes.grades {
            @if !grades.changes.is_empty() || !grades.causes.is_empty() {
                section aria-labelledby="grades" {
                    h2 #grades { "Final grades that changed" }
                    @if !grades.causes.is_empty() { p { "Changed: " (grades.causes.join(", ")) "." } }
                    @if grades.changes.is_empty() { p { "No final grade changed." } }
                    ul { @for change in &grades.changes { li { (sanitized(&change.to_string())) } } }
                }
            }
        }
        @let resubmitted = with_changed_points(&changes.resubmitted);
        @if !resubmitted.is_empty() {
            section aria-labelledby="resubmitted" {
                h2 #resubmitted { "Changed submissions" }
                (drifts(&resubmitted))
            }
        }
        @if !changes.removed.is_empty() {
            section aria-labelledby="removed" {
                h2 #removed { "No longer in the input" }
                ul { @for entry in &changes.removed { li { (sanitized(&entry.to_string())) } } }
            }
        }
    }
}

fn drifts(drifts: &[&Drift]) -> Markup {
    let now = |drift: &Drift| {
        drift
            .now
            .map_or("no score".to_owned(), |now| now.to_string())
    };
    let points = |points: Option<u32>| points.map_or("–".to_owned(), |points| points.to_string());
    html! {
        @if drifts.is_empty() { p { "No score changed." } }
        ul {
            @for drift in drifts {
                li {
                    a href=(report_link(&drift.id)) { (sanitized(&drift.id)) }
                    ": " strong { (drift.was) " → " (now(drift)) }
                    @if !drift.items.is_empty() { details {
                        summary { (item_count(drift.items.len())) }
                        ul { @for item in &drift.items {
                            li {
                                code { (sanitized(&item.item)) } " "
                                (points(item.was)) " → " (points(item.now)) ": "
                                (sanitized(&item.why))
                            }
                        } } }
                    }
                }
            }
        }
    }
}

fn item_count(count: usize) -> String {
    match count {
        1 => "1 item".to_owned(),
        count => format!("{count} items"),
    }
}
