//! Determines which items each mistake fails regardless of the seed.
//!
//! Some items catch a mistake only by luck: with other random numbers, no ray would reveal it. An
//! item is therefore listed for a mistake only if the mistake has failed it with each of many
//! seeds.

use std::collections::BTreeSet;
use std::ops::Range;

use anyhow::Result;
use judging::exam::{Exam, Item};
use rayon::prelude::*;

use crate::proof::detections::{Detection, Detections};
use crate::proof::run::{exam_of, for_seeds, run};
use crate::solutions::Solutions;
use crate::solutions::failed_items::{self, FailedItems};
use crate::solutions::solution::Solution;
use crate::solutions::workbench::BuiltSolution;

/// The default numbers of seeds for writing the lists in the repository.
pub const MANY_SEEDS: SeedCounts = SeedCounts::of(20);
/// The default numbers of seeds for a check, which must be fast. Most mistakes are only graded with
/// the practice exam.
pub const FEW_SEEDS: SeedCounts = SeedCounts {
    all: 0,
    thinnest: 1,
};
/// The number of mistakes that are graded with more seeds because they are caught least clearly.
pub const THINNEST: usize = 50;

/// The numbers of seeds that the mistakes are graded with. The first seed is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeedCounts {
    /// The number of seeds for each mistake.
    pub all: u64,
    /// The number of seeds for the [`THINNEST`] mistakes that are caught least clearly.
    pub thinnest: u64,
}

impl SeedCounts {
    /// Returns counts with ten times as many seeds for the least clearly caught mistakes.
    pub const fn of(all: u64) -> Self {
        SeedCounts {
            all,
            thinnest: 10 * all,
        }
    }
}

/// Determines which items each mistake fails in the practice exam and in the exams for these seeds,
/// and how clearly these exams catch the mistake. The least clearly caught mistakes are graded with
/// more seeds.
pub fn failed_items(
    solutions: &Solutions,
    practice: &Exam,
    seeds: SeedCounts,
) -> Result<(FailedItems, Detections)> {
    let (workbench, mistakes) = (&solutions.workbench, &solutions.mistakes);
    let built = run(workbench, mistakes, "mistakes built", |mistake, built| {
        Ok((mistake, built))
    })?;
    let all: Vec<&(&Solution, BuiltSolution)> = built.iter().collect();
    let mut of_exams = caught_with_seeds(solutions, &all, 0..seeds.all)?;
    of_exams.push(caught_in(&all, practice)?);
    let mut detections = Detections::default();
    detections.add_all(&all, &of_exams);
    let thinnest = detections.by_clarity().into_iter().take(THINNEST);
    let thinnest: BTreeSet<&str> = thinnest.map(|(id, ..)| id).collect();
    let again = all.into_iter();
    let again = again.filter(|(mistake, _)| thinnest.contains(mistake.id.as_str()));
    let again: Vec<_> = again.collect();
    let more = caught_with_seeds(solutions, &again, seeds.all..seeds.thinnest)?;
    detections.add_all(&again, &more);

    let with_every_seed = |index: usize| -> Vec<String> {
        let items = practice.items.iter().map(|item| &item.id);
        let always = items.filter(|id| {
            let mut all = of_exams.iter();
            all.all(|caught| caught[index].iter().any(|caught| caught.item == **id))
        });
        always.cloned().collect()
    };
    let fails = built.iter().enumerate();
    let failed = FailedItems {
        seeds: seeds.all,
        fails: fails
            .map(|(index, (mistake, _))| (mistake.id.clone(), with_every_seed(index)))
            .collect(),
    };
    Ok((failed, detections))
}

/// For each seed and each mistake, returns how the exam detects the mistake.
fn caught_with_seeds(
    solutions: &Solutions,
    built: &[&(&Solution, BuiltSolution)],
    seeds: Range<u64>,
) -> Result<Vec<Vec<Vec<Detection>>>> {
    for_seeds(seeds, |seed| caught_in(built, &exam_of(solutions, seed)?))
}

/// For each mistake, returns how the exam detects it.
fn caught_in(built: &[&(&Solution, BuiltSolution)], exam: &Exam) -> Result<Vec<Vec<Detection>>> {
    let caught = built
        .par_iter()
        .map(|(mistake, solution)| detections(mistake, solution, exam));
    caught.collect()
}

/// Returns how the items of a mistake's tasks detect it. No parts of the solution are substituted.
fn detections(mistake: &Solution, solution: &BuiltSolution, exam: &Exam) -> Result<Vec<Detection>> {
    let mut caught = Vec::new();
    for task in &mistake.expected.tasks {
        let items = exam.items.iter().filter(|item| item.task == *task);
        let items: Vec<&Item> = items.collect();
        let answers = solution.answers_to_each(&items)?;
        let answered = items.into_iter().zip(&answers);
        caught.extend(answered.filter_map(|(item, answers)| Detection::of_item(item, answers)));
    }
    Ok(caught)
}

/// Returns the differences between the committed lists and the lists from a check, one line each. A
/// check with fewer seeds finds longer lists, so additional items aren't reported.
pub fn problems(committed: &FailedItems, found: &FailedItems) -> Vec<String> {
    let command = "run `cargo author mistakes`";
    let path = failed_items::FILE;
    let (known, listed) = (&found.fails, &committed.fails);
    let unlisted = known.keys().filter(|id| !listed.contains_key(*id));
    let unlisted = unlisted.map(|id| format!("{path} does not list {id}: {command}"));
    let unknown = listed.keys().filter(|id| !known.contains_key(*id));
    let unknown = unknown.map(|id| format!("{path} lists {id}, which does not exist: {command}"));
    let passed = found.fails.iter().flat_map(|(id, found)| {
        let listed = committed.of_mistake(id).iter();
        let passed = listed.filter(|item| !found.contains(item));
        passed.map(move |item| format!("{path}: {id} does not fail {item}: {command}"))
    });
    unlisted.chain(unknown).chain(passed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(seeds: u64, fails: &[(&str, &[&str])]) -> FailedItems {
        let owned = |items: &[&str]| items.iter().map(|&item| item.to_owned()).collect();
        let fails = fails.iter();
        let fails = fails.map(|&(id, items)| (id.to_owned(), owned(items)));
        FailedItems {
            seeds,
            fails: fails.collect(),
        }
    }

    #[test]
    fn a_check_with_fewer_seeds_may_find_more_failed_items() {
        let committed = failed(100, &[("bbox.a", &["bbox.through"])]);
        let found = failed(1, &[("bbox.a", &["bbox.through", "bbox.flat"])]);
        assert_eq!(problems(&committed, &found), [""; 0]);
    }

    #[test]
    fn reports_unlisted_and_unknown_mistakes_and_items_that_pass() {
        let committed = failed(100, &[("bbox.a", &["bbox.flat"]), ("bbox.old", &[])]);
        let found = failed(1, &[("bbox.a", &[]), ("bbox.new", &["bbox.flat"])]);
        assert_eq!(
            problems(&committed, &found),
            [
                "mistakes/fails.toml does not list bbox.new: run `cargo author mistakes`",
                "mistakes/fails.toml lists bbox.old, which does not exist: run `cargo \
                 author mistakes`",
                "mistakes/fails.toml: bbox.a does not fail bbox.flat: run `cargo author \
                 mistakes`",
            ]
        );
    }
}
