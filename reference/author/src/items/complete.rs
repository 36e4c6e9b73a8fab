//! Regenerates items until every exam tests every class of each task's domain.

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
pub(super) fn draw_items(
    seed: Seed,
    task: &AuthoredTask,
    items: &[Declaration],
    practice: &[Item],
) -> Vec<DeclaredItem> {
    draw_complete(seed, task, items, |seed, index| {
        let item = &items[index];
        match practice.iter().find(|it| it.id == item.id) {
            Some(practice) => draw_distinct(seed, item, practice),
            None => item.draw(seed),
        }
    })
}

/// Generates the items of a task. While any class of the task's domain is missing, items that could
/// test it are regenerated. A new item is kept only if it reduces the number of missing classes.
fn draw_complete(
    seed: Seed,
    task: &AuthoredTask,
    items: &[Declaration],
    draw: impl Fn(Seed, usize) -> DeclaredItem,
) -> Vec<DeclaredItem> {
    let finish = |drawn: &[DeclaredItem]| {
        let mut finished = drawn.to_vec();
        (task.finish)(seed, &mut finished);
        finished
    };
    let mut drawn: Vec<DeclaredItem> = (0..items.len()).map(|index| draw(seed, index)).collect();
    let mut finished = finish(&drawn);
    let Some(domain) = task.domain else {
        return finished;
    };
    let count = |item: &DeclaredItem| Classes::of_item(domain, item.item());
    let mut counts: Vec<Classes> = finished.iter().map(count).collect();
    let mut missing = missing_columns(domain, &counts);
    let mut seeds = vec![seed; items.len()];
    for index in (0..ATTEMPTS).flat_map(|_| 0..items.len()) {
        if missing.is_empty() {
            break;
        }
        if !tests_any(&counts[index], &missing) {
            continue;
        }
        seeds[index] = seeds[index].next();
        let before = mem::replace(&mut drawn[index], draw(seeds[index], index));
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
        let other_counts: Vec<Classes> = recounted.collect();
        let still_missing = missing_columns(domain, &other_counts);
        if still_missing.len() < missing.len() {
            (finished, counts, missing) = (others, other_counts, still_missing);
        } else {
            drawn[index] = before;
        }
    }
    finished
}

/// Returns the column of each missing class, and an empty name for each missing pair of classes.
fn missing_columns(domain: &dyn Domain, counts: &[Classes]) -> Vec<String> {
    let classes = Classes::sum(counts);
    let cells = classes.cells(domain).into_iter();
    let cells = cells
        .filter(|cell| cell.is_missing())
        .map(|cell| cell.column);
    let pairs = classes.pairs(domain).into_iter();
    let pairs = pairs.filter(|pair| pair.is_missing());
    cells.chain(pairs.map(|_| String::new())).collect()
}

/// Returns whether an item tests the domain's function in at least one of these columns. An empty
/// name stands for any column.
fn tests_any(counts: &Classes, columns: &[String]) -> bool {
    let tested = counts.columns();
    let is_tested = |column: &String| column.is_empty() || tested.contains(column);
    !tested.is_empty() && columns.iter().any(is_tested)
}
