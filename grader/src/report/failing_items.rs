//! The failing items of a task: which are most informative, and which share a hint, so that a
//! report shows the hint only once.

use crate::score::{ItemScore, TaskScore, VerdictKind};

/// Returns the failing items of a task, the most informative first: items whose mistake is
/// recognised, items whose failure shows what to look for, items with a wrong answer, and items
/// without one. Equals keep the exam's order, which goes from simple to difficult.
pub(super) fn most_telling_first(task: &TaskScore) -> Vec<&ItemScore> {
    let failing = task
        .items
        .iter()
        .filter(|item| item.points < item.max_points);
    let mut failing: Vec<&ItemScore> = failing.collect();
    failing.sort_by_key(|item| match item.verdict.kind() {
        _ if !item.hints.is_empty() => 0,
        VerdictKind::Failed if item.clue.is_some() => 1,
        VerdictKind::Failed => 2,
        VerdictKind::NoAnswer if item.evidence.is_some() => 3,
        VerdictKind::Passed
        | VerdictKind::NoAnswer
        | VerdictKind::Unwritten
        | VerdictKind::NotCompiled
        | VerdictKind::Blocked
        | VerdictKind::Pending => 4,
    });
    failing
}

/// Returns the first failing item and those others with evidence and a different hint from the
/// items before them.
pub(super) fn with_something_new<'a>(failing: &[&'a ItemScore]) -> Vec<&'a ItemScore> {
    let mut shown: Vec<&ItemScore> = Vec::new();
    for &item in failing {
        let is_explained = shown.iter().any(|shown| is_same_hint(shown, item));
        if shown.is_empty() || (item.evidence.is_some() && !is_explained) {
            shown.push(item);
        }
    }
    shown
}

/// Returns whether one hint explains both items.
fn is_same_hint(a: &ItemScore, b: &ItemScore) -> bool {
    !a.hints.is_empty() && a.hints == b.hints
}

/// Returns the ids of the other failing items that the item's hint explains.
pub(super) fn explained_items<'a>(item: &ItemScore, failing: &[&'a ItemScore]) -> Vec<&'a str> {
    let explained = failing
        .iter()
        .filter(|other| other.id != item.id && is_same_hint(item, other));
    explained.map(|other| other.id.as_str()).collect()
}
