//! Determines which failing items of a task are most informative, and which of them share a hint,
//! so that a report shows the hint only once.

use crate::score::{ItemScore, Score, TaskScore, VerdictKind};

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
        // A panic's clue is about its message, which says little about what else is wrong.
        VerdictKind::Failed if item.clue.is_some() && item.at.is_none() => 1,
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

/// Returns the item to fix first and its task: the most informative failing item of the first
/// selected task that isn't only blocked by other tasks. If the task's file doesn't compile and
/// contains several tasks' methods, the task is the last one whose method starts above the
/// compiler's first error.
pub(super) fn first_to_fix(
    score: &Score,
    is_selected: impl Fn(&TaskScore) -> bool,
) -> Option<(&TaskScore, &ItemScore)> {
    let selected = || score.tasks.iter().filter(|task| is_selected(task));
    let with_item = |task| Some((task, *most_informative_first(task).first()?));
    let can_be_fixed = |found: &(_, &ItemScore)| found.1.verdict.kind() != VerdictKind::Blocked;
    let with_items = || selected().filter_map(with_item);
    let first = with_items().find(can_be_fixed);
    let first = first.or_else(|| with_items().next())?;
    if first.1.verdict.kind() != VerdictKind::NotCompiled {
        return Some(first);
    }
    let (file, _) = file_and_line(first.0);
    let mut reports = score.build.not_compiled.iter();
    let report = reports.find(|report| report.file == file);
    let error = report.and_then(|report| report.line);
    let is_above = |task: &&TaskScore| {
        let (of_task, method) = file_and_line(task);
        of_task == file
            && method
                .zip(error)
                .is_some_and(|(method, error)| method <= error)
    };
    let above = selected().filter(is_above);
    let nearest = above.max_by_key(|task| file_and_line(task).1);
    Some(nearest.and_then(with_item).unwrap_or(first))
}

/// Returns all failing items, beginning with the [item to fix first](first_to_fix). Items that are
/// blocked by other tasks come last.
pub(super) fn in_order_to_fix(score: &Score) -> Vec<&ItemScore> {
    let first = first_to_fix(score, |_| true).map(|(_, item)| &item.id);
    let failing = score.tasks.iter().flat_map(most_informative_first);
    let mut failing: Vec<&ItemScore> = failing.collect();
    failing.sort_by_key(|item| {
        let is_blocked = item.verdict.kind() == VerdictKind::Blocked;
        (Some(&item.id) != first, is_blocked)
    });
    failing
}

/// Returns a task's file and, if it is known, the line of its method.
fn file_and_line(task: &TaskScore) -> (&str, Option<u32>) {
    match task.method.split_once(':') {
        Some((file, line)) => (file, line.parse().ok()),
        None => (&task.method, None),
    }
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
