//! Measures the exam's margins: how far its thresholds are from correct and from wrong answers.
//!
//! Every variant is correct, so all of its answers must be well within the thresholds. Every
//! mistake must be well beyond a threshold in at least one of the items it must fail. The judge
//! computes the deviations in the same way as for grading.

mod deviations;
pub mod margins;
pub mod table;

use std::ops::Range;

use anyhow::Result;
use judging::exam::{Exam, Item};
use judging::judge::Threshold;

use crate::proof::calibrate::margins::{DeviationSample, Margin, Margins};
use crate::proof::grade::tasks_and_dependents;
use crate::proof::run::{exam_of, for_seeds, run};
use crate::solutions::Solutions;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::BuiltSolution;

/// The default seeds for writing the table in the repository.
pub const MANY_SEEDS: Range<u64> = 0..200;
/// The default seeds for a check, which must be fast.
pub const FEW_SEEDS: Range<u64> = 0..2;

/// The margins of all thresholds, and the seeds and solutions used to measure them.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The seeds of the exams that the variants were graded with.
    pub seeds: Range<u64>,
    /// The seeds of the exams that the mistakes were graded with: the first few of `seeds`.
    pub mistake_seeds: Range<u64>,
    /// The number of variants.
    pub variants: usize,
    /// The number of mistakes.
    pub mistakes: usize,
    /// The measured margins.
    pub margins: Margins,
}

impl Calibration {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        let margin = |of: fn(&Margin) -> f64| {
            let margins = Threshold::all()
                .into_iter()
                .map(|threshold| of(&self.margins.margin(threshold)));
            margins.into_iter().fold(f64::INFINITY, f64::min)
        };
        format!(
            "variants {}, seeds {}, mistakes {} ({} seeds), smallest margins {:.2} for correct \
             answers, {:.2} for mistakes",
            self.variants,
            self.seeds.end - self.seeds.start,
            self.mistakes,
            self.mistake_seeds.end - self.mistake_seeds.start,
            margin(Margin::correct_margin),
            margin(Margin::mistake_margin),
        )
    }
}

/// Measures the margins with the exams for these seeds. All variants are graded with every exam,
/// and all mistakes with the first `with_mistakes` exams.
pub fn calibrate(
    solutions: &Solutions,
    seeds: Range<u64>,
    with_mistakes: u64,
) -> Result<Calibration> {
    let all = solutions.variants.iter().chain(&solutions.mistakes);
    let built = run(
        &solutions.workbench,
        all,
        "solutions built",
        |solution, built| Ok((solution, built)),
    )?;
    let (variants, mistakes) = built.split_at(solutions.variants.len());
    let mistake_seeds = seeds.start..seeds.end.min(seeds.start + with_mistakes);
    let of_seeds = for_seeds(seeds.clone(), |seed| {
        let is_wanted = mistake_seeds.contains(&seed);
        let mistakes = if is_wanted { mistakes } else { &[] };
        margins(seed, &exam_of(solutions, seed)?, variants, mistakes)
    })?;
    Ok(Calibration {
        seeds,
        mistake_seeds,
        variants: solutions.variants.len(),
        mistakes: solutions.mistakes.len(),
        margins: of_seeds
            .into_iter()
            .fold(Margins::default(), Margins::merge),
    })
}

/// Measures the margins with the exam for one seed.
fn margins(
    seed: u64,
    exam: &Exam,
    variants: &[(&Solution, BuiltSolution)],
    mistakes: &[(&Solution, BuiltSolution)],
) -> Result<Margins> {
    let sample = |deviation, solution: &Solution, item: &Item| DeviationSample {
        deviation,
        solution: solution.id.clone(),
        item: item.id.clone(),
        seed,
    };
    let mut margins = Margins::default();
    for (variant, built) in variants {
        for item in &tasks_and_dependents(exam, &variant.expected.tasks).items {
            let may_lose = variant.expected.may_lose.contains(&item.id);
            for deviation in deviations::of_correct(item, &built.answers(item)?, may_lose) {
                margins.add_correct(sample(deviation, variant, item));
            }
        }
    }
    for (mistake, built) in mistakes {
        let must_fail = |item: &&Item| mistake.expected.fails.contains(&item.id);
        let items = exam.items.iter().filter(must_fail);
        let samples: Result<Vec<_>> = items
            .map(|item| {
                let deviation = deviations::of_mistake(item, &built.answers(item)?);
                Ok(sample(deviation, mistake, item))
            })
            .collect();
        margins.add_mistake_of_exam(samples?);
    }
    Ok(margins)
}
