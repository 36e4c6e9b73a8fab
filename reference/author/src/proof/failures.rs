//! Determines which items each mistake fails with every seed.
//!
//! Some items catch a mistake only by luck: with other random numbers, no ray would show it. Only
//! the items that fail with each of many seeds are required to fail with any seed.

use std::collections::BTreeSet;

use grader::probe::Fault;
use indicatif::ParallelProgressIterator;
use judging::exam::{Exam, Item};
use judging::judge::{Credit, judge};
use protocol::Answer;
use rayon::prelude::*;

use crate::exams;
use crate::proof::ProofError;
use crate::proof::progress::progress_bar;
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::failed_items::{self, FailedItems};
use crate::solutions::workbench::{BuiltSolution, WorkbenchError};

/// The default number of seeds for writing the lists in the repository.
pub const MANY_SEEDS: u64 = 100;
/// The default number of seeds for a check, which must be fast.
pub const FEW_SEEDS: u64 = 1;

/// Determines the items that each mistake fails in the practice exam and in the exams of the seeds
/// below `seeds`.
pub fn failed_items(
    solutions: &Solutions,
    practice: &Exam,
    seeds: u64,
) -> Result<FailedItems, ProofError> {
    let built: Vec<(&Mistake, BuiltSolution)> = solutions
        .mistakes
        .par_iter()
        .map(|(mistake, sources)| Ok((mistake, solutions.workbench.build(sources, &mistake.id)?)))
        .collect::<Result<_, WorkbenchError>>()?;
    let bar = progress_bar(seeds, "seeds");
    let of_seeds: Vec<Vec<BTreeSet<String>>> = (0..seeds)
        .into_par_iter()
        .progress_with(bar)
        .map(|seed| {
            let exam = exams::generate("proof", Seed(seed), &solutions.recorder)?;
            Ok(failed_by_each(&built, &exam)?)
        })
        .collect::<Result<_, ProofError>>()?;
    let of_practice = failed_by_each(&built, practice)?;

    let with_every_seed = |index: usize| -> Vec<String> {
        let items = practice.items.iter().map(|item| &item.id);
        let always = items.filter(|id| {
            let mut all = of_seeds.iter().chain([&of_practice]);
            all.all(|failed| failed[index].contains(*id))
        });
        always.cloned().collect()
    };
    let fails = built.iter().enumerate();
    Ok(FailedItems {
        seeds,
        fails: fails
            .map(|(index, (mistake, _))| (mistake.id.clone(), with_every_seed(index)))
            .collect(),
    })
}

/// Returns the items that each mistake fails in one exam.
fn failed_by_each(
    built: &[(&Mistake, BuiltSolution)],
    exam: &Exam,
) -> Result<Vec<BTreeSet<String>>, WorkbenchError> {
    let failed = built
        .par_iter()
        .map(|(mistake, solution)| failed_by_one(mistake, solution, exam));
    failed.collect()
}

/// Returns the items of a mistake's tasks that the mistake fails without the reference's parts.
fn failed_by_one(
    mistake: &Mistake,
    solution: &BuiltSolution,
    exam: &Exam,
) -> Result<BTreeSet<String>, WorkbenchError> {
    let mut failed = BTreeSet::new();
    for task in mistake.tasks() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        let answers = solution.answers_to_each(&items)?;
        let wrong = items.into_iter().zip(&answers);
        let wrong = wrong.filter(|(item, answers)| is_failed(item, answers));
        failed.extend(wrong.map(|(item, _)| item.id.clone()));
    }
    Ok(failed)
}

fn is_failed(item: &Item, answers: &Result<Vec<Answer>, Fault>) -> bool {
    match answers {
        Err(_) => true,
        Ok(answers) => {
            let mut answered = item.questions.iter().zip(answers);
            answered.any(|(question, answer)| judge(question, answer).credit < Credit::FULL)
        }
    }
}

/// Returns the differences between the committed lists and those of a check, one line each. A check
/// with fewer seeds finds longer lists, so only items that a mistake passes are reported.
pub fn problems(committed: &FailedItems, found: &FailedItems) -> Vec<String> {
    let command = "run `cargo author mistakes`";
    let path = failed_items::FILE;
    let unlisted = found
        .fails
        .keys()
        .filter(|id| !committed.fails.contains_key(*id));
    let unlisted = unlisted.map(|id| format!("{path} does not list {id}: {command}"));
    let unknown = committed
        .fails
        .keys()
        .filter(|id| !found.fails.contains_key(*id));
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
        FailedItems {
            seeds,
            fails: fails
                .iter()
                .map(|&(id, items)| (id.to_owned(), owned(items)))
                .collect(),
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
