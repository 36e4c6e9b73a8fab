//! Failing items that share a hint, so that a report shows the hint once.

use crate::score::ItemScore;

/// Returns the first failing item, and the others that have evidence and another hint than the items
/// before them.
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
