//! The sections about differences from earlier runs.

use maud::{Markup, html};

use super::sanitized;
use super::submissions::report_link;
use crate::regrade_diff::{Changes, Drift};
use crate::report::text::{points_now, points_of_item, with_changed_points};
use grader::printing::counted;

/// Renders the differences from earlier runs, if any.
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
                    ul { @for change in &grades.changes { li { (sanitized(change)) } } }
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
                ul { @for entry in &changes.removed { li { (sanitized(entry)) } } }
            }
        }
    }
}

fn drifts(drifts: &[&Drift]) -> Markup {
    html! {
        @if drifts.is_empty() { p { "No score changed." } }
        ul {
            @for drift in drifts {
                li {
                    a href=(report_link(&drift.id)) { (sanitized(&drift.id)) }
                    ": " strong { (drift.was) " → " (points_now(drift)) }
                    @if !drift.items.is_empty() { details {
                        summary { (counted(drift.items.len(), "item")) }
                        ul { @for item in &drift.items {
                            @let [was, now] = points_of_item(item);
                            li {
                                code { (sanitized(&item.item)) } " "
                                (was) " → " (now) ": "
                                (sanitized(&item.why))
                            }
                        } } }
                    }
                }
            }
        }
    }
}
