//! Draws items again until every exam tests every class of each task's domain.

use std::collections::BTreeMap;
use std::mem;
use std::sync::{Arc, Mutex};

use super::declaration::{AuthoredTask, Declaration, DeclaredItem};
use super::distinct::draw_distinct;
use crate::domains::Domain;
use crate::domains::classes::Classes;
use crate::seed::Seed;

/// The maximum number of times each item is drawn again.
const ATTEMPTS: usize = 96;

/// Draws the items of a task. In a final exam, the questions of an item differ from those of the
/// same item in the practice exam.
pub(super) fn draw_items(
    seed: Seed,
    task: &AuthoredTask,
    items: &[Declaration],
) -> Vec<DeclaredItem> {
    if seed == Seed::PRACTICE {
        return draw_complete(seed, task, items, |seed, index| items[index].draw(seed));
    }
    let practice = practice_items(task, items);
    draw_complete(seed, task, items, |seed, index| {
        draw_distinct(seed, &items[index], practice[index].item())
    })
}

/// Returns the items of the practice exam. They are drawn only once, even if many exams are
/// generated.
fn practice_items(task: &AuthoredTask, items: &[Declaration]) -> Arc<Vec<DeclaredItem>> {
    static DRAWN: Mutex<BTreeMap<Vec<&str>, Arc<Vec<DeclaredItem>>>> = Mutex::new(BTreeMap::new());
    let mut drawn = DRAWN.lock().expect("no item panics while it is drawn");
    let known = drawn.entry(items.iter().map(|item| item.id).collect());
    let practice = known.or_insert_with(|| Arc::new(draw_items(Seed::PRACTICE, task, items)));
    Arc::clone(practice)
}

/// Draws the items of a task. While any class of the task's domain is missing, items that could
/// test it are drawn again. A new item is kept only if it reduces the number of missing classes.
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
    let mut missing = missing_columns(domain, &finished);
    let mut seeds = vec![seed; items.len()];
    for index in (0..ATTEMPTS).flat_map(|_| 0..items.len()) {
        if missing.is_empty() {
            break;
        }
        if !asks_any(domain, &drawn[index], &missing) {
            continue;
        }
        seeds[index] = seeds[index].next();
        let before = mem::replace(&mut drawn[index], draw(seeds[index], index));
        let other = finish(&drawn);
        let still_missing = missing_columns(domain, &other);
        if still_missing.len() < missing.len() {
            (finished, missing) = (other, still_missing);
        } else {
            drawn[index] = before;
        }
    }
    finished
}

/// Returns the column of each missing class, and an empty name for each missing pair of classes.
fn missing_columns(domain: &dyn Domain, drawn: &[DeclaredItem]) -> Vec<String> {
    let classes = Classes::count(domain, drawn.iter().map(DeclaredItem::item));
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
fn asks_any(domain: &dyn Domain, item: &DeclaredItem, columns: &[String]) -> bool {
    let asked = Classes::count(domain, [item.item()]).columns;
    let is_asked = |column: &String| column.is_empty() || asked.contains(column);
    !asked.is_empty() && columns.iter().any(is_asked)
}
