//! Regenerates items until every exam tests every class of each task's domains.

use std::mem;

use judging::exam::Item;

use super::declaration::{AuthoredTask, Declaration, DeclaredItem};
use super::distinct::draw_distinct;
use crate::domains::Domain;
use crate::domains::classes::Classes;
use crate::seed::Seed;

/// The maximum number of times each item is regenerated.
const ATTEMPTS: usize = 96;

/// Generates the items of a task. If `practice` contains the same item, the item's questions differ
/// from those in the practice exam.
///
/// While any class of the task's domains is missing, items that could test it are regenerated. A new
/// item is kept only if it reduces the number of missing classes.
pub(super) fn draw_items(seed: Seed, task: &AuthoredTask, practice: &[Item]) -> Vec<DeclaredItem> {
    let draw = |seed: Seed, item: &Declaration| match practice.iter().find(|it| it.id == item.id) {
        Some(practice) => draw_distinct(seed, item, practice),
        None => item.draw(seed),
    };
    let finish = |drawn: &[DeclaredItem]| {
        let mut finished = drawn.to_vec();
        (task.finish)(seed, &mut finished);
        finished
    };
    let items = task.items;
    let drawn = items.iter().map(|item| draw(seed, item));
    let mut drawn: Vec<DeclaredItem> = drawn.collect();
    let mut finished = finish(&drawn);
    let count = |item: &DeclaredItem| -> Vec<Classes> {
        let domains = task.domains.iter();
        let counts = domains.map(|domain| Classes::of_item(*domain, item.item()));
        counts.collect()
    };
    let mut counts: Vec<Vec<Classes>> = finished.iter().map(count).collect();
    let mut missing = missing_columns(task.domains, &counts);
    let mut seeds = vec![seed; items.len()];
    for index in (0..ATTEMPTS).flat_map(|_| 0..items.len()) {
        if missing.is_empty() {
            break;
        }
        if !tests_any(&counts[index], &missing) {
            continue;
        }
        seeds[index] = seeds[index].next();
        let before = mem::replace(&mut drawn[index], draw(seeds[index], &items[index]));
        let others = finish(&drawn);
        // Only a few items have changed.
        let recounted = others.iter().zip(&finished).zip(&counts);
        let recounted = recounted.map(|((other, item), counted)| {
            if other.item() == item.item() {
                counted.clone()
            } else {
                count(other)
            }
        });
        let other_counts: Vec<Vec<Classes>> = recounted.collect();
        let still_missing = missing_columns(task.domains, &other_counts);
        if still_missing.len() < missing.len() {
            (finished, counts, missing) = (others, other_counts, still_missing);
        } else {
            drawn[index] = before;
        }
    }
    finished
}

/// Returns, for each missing class, the index of its domain and the column, and for each missing
/// pair of classes, the index and an empty name. `counts` contains the counts for each domain in
/// each item.
fn missing_columns(domains: &[&dyn Domain], counts: &[Vec<Classes>]) -> Vec<(usize, String)> {
    let missing = domains.iter().enumerate().flat_map(|(index, &domain)| {
        let classes = Classes::sum(counts.iter().map(|of_item| &of_item[index]));
        let cells = classes.cells(domain).into_iter();
        let cells = cells
            .filter(|cell| cell.is_missing())
            .map(|cell| cell.column);
        let pairs = classes.pairs(domain).into_iter();
        let pairs = pairs.filter(|pair| pair.is_missing());
        let columns = cells.chain(pairs.map(|_| String::new()));
        columns.map(move |column| (index, column))
    });
    missing.collect()
}

/// Returns whether an item tests a domain's function in at least one of these columns. An empty
/// name stands for any column.
fn tests_any(counts: &[Classes], columns: &[(usize, String)]) -> bool {
    columns.iter().any(|(index, column)| {
        let tested = counts[*index].columns();
        !tested.is_empty() && (column.is_empty() || tested.contains(column))
    })
}
