//! What a regrade has changed: whose points, in which items, and why. Pure.

use serde::Serialize;

use crate::outcome::{Item, Told};

/// Whose score changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Drift {
    /// The entry's id.
    pub id: String,
    /// What it had.
    pub was: u32,
    /// What it has. None if it has no score any more.
    pub now: Option<u32>,
    /// Where that comes from.
    pub items: Vec<Change>,
}

/// An item that earns something else.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// Which.
    pub item: String,
    /// What it had earned. None if it was not asked.
    pub was: Option<u32>,
    /// What it earns. None if it is not asked any more.
    pub now: Option<u32>,
    /// What is said of it now, else what was.
    pub why: String,
}

/// What changed for one entry. None if nothing did.
pub fn drift(id: &str, was: &Told, now: Option<&Told>) -> Option<Drift> {
    let items = match now {
        Some(now) => changes(was, now),
        None => Vec::new(),
    };
    let is_same = now.is_some_and(|now| now.points == was.points) && items.is_empty();
    (!is_same).then(|| Drift {
        id: id.to_owned(),
        was: was.points,
        now: now.map(|now| now.points),
        items,
    })
}

fn changes(was: &Told, now: &Told) -> Vec<Change> {
    let find = |told: &Told, id: &str| told.items().find(|item| item.id == id).cloned();
    let changed = now.items().filter_map(|item| {
        let old = find(was, &item.id);
        let same = old.as_ref().is_some_and(|old| old.points == item.points);
        (!same).then(|| change(old.as_ref(), Some(item)))
    });
    let gone = was.items().filter(|item| find(now, &item.id).is_none());
    changed
        .chain(gone.map(|item| change(Some(item), None)))
        .collect()
}

fn change(was: Option<&Item>, now: Option<&Item>) -> Change {
    let told = |item: &Item| match item.message.as_str() {
        "" => item.verdict.clone(),
        message => format!("{}: {message}", item.verdict),
    };
    let why = match (was, now) {
        // What it lost its points for is over.
        (Some(was), Some(now)) if now.points > was.points => {
            format!("{}; it was {}", told(now), told(was))
        }
        (_, Some(now)) => told(now),
        (_, None) => "not asked any more".to_owned(),
    };
    let item = now.or(was).map(|item| item.id.clone());
    Change {
        item: item.unwrap_or_default(),
        was: was.map(|item| item.points),
        now: now.map(|item| item.points),
        why,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Task;

    fn told(items: &[(&str, u32, &str)]) -> Told {
        let item = |(id, points, verdict): &(&str, u32, &str)| Item {
            id: (*id).to_owned(),
            title: String::new(),
            points: *points,
            max_points: 2,
            verdict: (*verdict).to_owned(),
            message: String::new(),
            hints: Vec::new(),
        };
        let items: Vec<Item> = items.iter().map(item).collect();
        let points = items.iter().map(|item| item.points).sum();
        Told {
            points,
            max_points: 2 * items.len() as u32,
            tasks: vec![Task {
                id: String::new(),
                title: String::new(),
                points,
                max_points: 0,
                items,
            }],
        }
    }

    #[test]
    fn what_changed_is_told_item_by_item_even_where_the_sum_is_the_same() {
        let was = told(&[("a", 2, "pass"), ("b", 0, "wrong"), ("c", 1, "partial")]);
        let now = told(&[("a", 0, "timed_out"), ("b", 2, "pass"), ("d", 1, "partial")]);
        let drift = drift("x", &was, Some(&now)).unwrap();
        let lines: Vec<_> = drift
            .items
            .iter()
            .map(|c| (c.item.as_str(), c.was, c.now))
            .collect();
        let wanted = [
            ("a", Some(2), Some(0)),
            ("b", Some(0), Some(2)),
            ("d", None, Some(1)),
            ("c", Some(1), None),
        ];
        assert_eq!(lines, wanted);
        assert_eq!(drift.items[1].why, "pass; it was wrong");
    }

    #[test]
    fn the_same_is_no_drift() {
        let was = told(&[("a", 2, "pass")]);
        assert_eq!(drift("x", &was, Some(&was.clone())), None);
        assert!(drift("x", &was, None).is_some());
    }
}
