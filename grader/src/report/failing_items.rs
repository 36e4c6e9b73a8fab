//! Determines which failing items of a task are most informative, and which of them share a hint,
//! so that a report shows the hint only once.

use crate::score::{ItemScore, TaskScore, VerdictKind};

/// Returns the failing items of a task, the most informative first: items whose mistake is
/// recognised, items whose failure shows what to look for, items with a wrong answer, and items
/// without an answer. Items of equal rank keep the exam's order, which goes from simple to
/// difficult.
pub(super) fn most_informative_first(task: &TaskScore) -> Vec<&ItemScore> {
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

/// Returns at most this many of a task's failing items, the most informative first. Every item
/// after the first has evidence, has a different hint from the first, and fails in a different way.
pub(super) fn most_new(task: &TaskScore, most: usize) -> Vec<&ItemScore> {
    let failing = most_informative_first(task);
    let Some((&first, others)) = failing.split_first() else {
        return Vec::new();
    };
    let is_alike = |other: &ItemScore| {
        is_same_hint(first, other)
            || (first.symptom.is_some() && first.symptom == other.symptom)
            || (first.at.is_some() && first.at == other.at)
    };
    let others = others.iter().copied();
    let others = others.filter(|other| other.evidence.is_some() && !is_alike(other));
    [first].into_iter().chain(others).take(most).collect()
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
