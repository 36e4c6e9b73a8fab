//! Measures how far the exam's thresholds are from correct and from wrong answers.
//!
//! Every variant is correct, so all of its answers must be well within the thresholds. Every
//! mistake must be well beyond a threshold in at least one of the items that it must fail. The
//! deviations are those that the judge computes for grading.

mod deviations;
pub mod margins;
pub mod table;

use std::ops::Range;

use indicatif::ParallelProgressIterator;
use judging::judge::Threshold;
use rayon::prelude::*;

use crate::exams;
use crate::proof::ProofError;
use crate::proof::calibrate::margins::{DeviationSample, Margin, Margins};
use crate::proof::grade::tasks_and_dependents;
use crate::proof::progress::progress_bar;
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::{BuiltSolution, WorkbenchError};

/// The default seeds for writing the table in the repository.
pub const MANY_SEEDS: Range<u64> = 0..200;
/// The default seeds for a check, which must be fast.
pub const FEW_SEEDS: Range<u64> = 0..2;

/// The margins of all thresholds, and the seeds and solutions that they were measured with.
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
    /// The margins that were measured.
    pub margins: Margins,
}

impl Calibration {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        let margin = |of: fn(&Margin) -> f64| {
            let margins = Threshold::ALL.map(|threshold| of(&self.margins.margin(threshold)));
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

/// Measures the margins with the exams of these seeds. All variants are graded with every exam, and
/// all mistakes with the first `with_mistakes` of them.
pub fn calibrate(
    solutions: &Solutions,
    seeds: Range<u64>,
    with_mistakes: u64,
) -> Result<Calibration, ProofError> {
    let built = BuiltSolutions::build(solutions)?;
    let mistake_seeds = seeds.start..seeds.end.min(seeds.start + with_mistakes);
    let of_seeds: Result<Vec<Margins>, ProofError> = seeds
        .clone()
        .into_par_iter()
        .progress_with(progress_bar(seeds.end - seeds.start, "seeds"))
        .map(|seed| built.margins(seed, mistake_seeds.contains(&seed)))
        .collect();
    Ok(Calibration {
        seeds,
        mistake_seeds,
        variants: solutions.variants.len(),
        mistakes: solutions.mistakes.len(),
        margins: of_seeds?
            .into_iter()
            .fold(Margins::default(), Margins::merge),
    })
}

/// All solutions and their programs.
struct BuiltSolutions<'a> {
    solutions: &'a Solutions,
    /// The built variants, in the order of `solutions`.
    variants: Vec<BuiltSolution>,
    /// The built mistakes, in the order of `solutions`.
    mistakes: Vec<BuiltSolution>,
}

impl<'a> BuiltSolutions<'a> {
    fn build(solutions: &'a Solutions) -> Result<Self, WorkbenchError> {
        let variants = solutions.variants.iter();
        let variants = variants.map(|(variant, sources)| (&variant.id, sources));
        let mistakes = solutions.mistakes.iter();
        let mistakes = mistakes.map(|(mistake, sources)| (&mistake.id, sources));
        let build = |(id, sources): (&String, &Sources)| solutions.workbench.build(sources, id);
        let all: Vec<_> = variants.chain(mistakes).collect();
        let count = all.len() as u64;
        let built = all
            .into_par_iter()
            .progress_with(progress_bar(count, "solutions built"))
            .map(build);
        let mut variants = built.collect::<Result<Vec<BuiltSolution>, WorkbenchError>>()?;
        let mistakes = variants.split_off(solutions.variants.len());
        Ok(BuiltSolutions {
            solutions,
            variants,
            mistakes,
        })
    }

    /// Measures the margins with the exam of one seed.
    fn margins(&self, seed: u64, with_mistakes: bool) -> Result<Margins, ProofError> {
        let exam = exams::generate("calibration", Seed(seed), &self.solutions.recorder)?;
        let sample = |deviation, solution: &str, item: &str| DeviationSample {
            deviation,
            solution: solution.to_owned(),
            item: item.to_owned(),
            seed,
        };
        let mut margins = Margins::default();
        let assignment = self.solutions.workbench.handed_out().assignment;

        for ((variant, _), solution) in self.solutions.variants.iter().zip(&self.variants) {
            let exam = tasks_and_dependents(&exam, &variant.tasks(assignment));
            for item in &exam.items {
                let answers = solution.answers(item).map_err(WorkbenchError::from)?;
                let may_lose = variant.may_lose.contains(&item.id);
                for deviation in deviations::of_correct(item, &answers, may_lose) {
                    margins.add_correct(sample(deviation, &variant.id, &item.id));
                }
            }
        }

        let mistakes = self.solutions.mistakes.iter().zip(&self.mistakes);
        for ((mistake, _), solution) in mistakes.filter(|_| with_mistakes) {
            let must_fail = |id: &String| mistake.fails.contains(id);
            let items = exam.items.iter().filter(|item| must_fail(&item.id));
            let samples: Result<Vec<_>, ProofError> = items
                .map(|item| {
                    let answers = solution.answers(item).map_err(WorkbenchError::from)?;
                    let deviation = deviations::of_mistake(item, &answers);
                    Ok(sample(deviation, &mistake.id, &item.id))
                })
                .collect();
            margins.add_mistake_of_exam(samples?);
        }
        Ok(margins)
    }
}
