//! How far the exam's thresholds stand from both sides: measured, not believed.
//!
//! Every variant is right, so all its answers must be well within what is tolerated; every mistake
//! must be well beyond, in each item that it is said to fail. How far off an answer is, the judge
//! itself says.

mod deviations;
pub mod margins;
pub mod table;

use std::ops::Range;

use grader::judge::Threshold;
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::exams;
use crate::proof::calibrate::margins::{DeviationSample, Margin, Margins};
use crate::proof::solutions::{ProofError, Solutions, tasks_and_dependents};
use crate::proof::sources::Sources;
use crate::proof::workbench::{BuiltSolution, WorkbenchError};
use crate::seed::Seed;

/// What the table in the repository was measured with.
pub const MANY_SEEDS: Range<u64> = 0..200;
/// What a check has time for.
pub const FEW_SEEDS: Range<u64> = 0..2;

/// What was asked, and how near to the thresholds the answers came.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The exams that the variants were asked.
    pub seeds: Range<u64>,
    /// Those of them that the mistakes were asked as well.
    pub mistake_seeds: Range<u64>,
    /// How many variants there are.
    pub variants: usize,
    /// How many mistakes there are.
    pub mistakes: usize,
    /// How near they came.
    pub margins: Margins,
}

impl Calibration {
    /// The closing line.
    pub fn summary_line(&self) -> String {
        let margin = |of: fn(&Margin) -> f64| {
            let margins = Threshold::ALL.map(|threshold| of(&self.margins.margin(threshold)));
            margins.into_iter().fold(f64::INFINITY, f64::min)
        };
        format!(
            "variants {}, seeds {}, mistakes {} ({} seeds), smallest margins {:.2} of right answers, \
             {:.2} of mistakes",
            self.variants,
            self.seeds.end - self.seeds.start,
            self.mistakes,
            self.mistake_seeds.end - self.mistake_seeds.start,
            margin(Margin::correct_margin),
            margin(Margin::mistake_margin),
        )
    }
}

/// Asks all variants in the exams of these seeds, and all mistakes in the first `with_mistakes` of
/// them.
pub fn calibrate(
    exhibits: &Solutions,
    seeds: Range<u64>,
    with_mistakes: u64,
) -> Result<Calibration, ProofError> {
    let asked = BuiltSolutions::build(exhibits)?;
    let seeds_of_mistakes = seeds.start..seeds.end.min(seeds.start + with_mistakes);
    let of_seeds: Result<Vec<Margins>, ProofError> = seeds
        .clone()
        .into_par_iter()
        .progress_with(progress_bar(seeds.end - seeds.start, "seeds"))
        .map(|seed| asked.margins(seed, seeds_of_mistakes.contains(&seed)))
        .collect();
    Ok(Calibration {
        seeds,
        mistake_seeds: seeds_of_mistakes,
        variants: exhibits.variants.len(),
        mistakes: exhibits.mistakes.len(),
        margins: of_seeds?
            .into_iter()
            .fold(Margins::default(), Margins::merge),
    })
}

/// All solutions, built.
struct BuiltSolutions<'a> {
    exhibits: &'a Solutions,
    /// In the order of the exhibits.
    variants: Vec<BuiltSolution>,
    /// In the order of the exhibits.
    mistakes: Vec<BuiltSolution>,
}

impl<'a> BuiltSolutions<'a> {
    fn build(exhibits: &'a Solutions) -> Result<Self, WorkbenchError> {
        let variants = exhibits.variants.iter();
        let variants = variants.map(|(variant, sources)| (&variant.id, sources));
        let mistakes = exhibits.mistakes.iter();
        let mistakes = mistakes.map(|(mistake, sources)| (&mistake.id, sources));
        let build = |(id, sources): (&String, &Sources)| exhibits.workbench.build(sources, id);
        let all: Vec<_> = variants.chain(mistakes).collect();
        let count = all.len() as u64;
        let built = all
            .into_par_iter()
            .progress_with(progress_bar(count, "solutions built"))
            .map(build);
        let mut variants = built.collect::<Result<Vec<BuiltSolution>, WorkbenchError>>()?;
        let mistakes = variants.split_off(exhibits.variants.len());
        Ok(BuiltSolutions {
            exhibits,
            variants,
            mistakes,
        })
    }

    /// What one seed's exam adds.
    fn margins(&self, seed: u64, with_mistakes: bool) -> Result<Margins, ProofError> {
        let exam = exams::generate("calibration", Seed(seed), &self.exhibits.recorder)?;
        let sighting = |deviation, of: &str, item: &str| DeviationSample {
            deviation,
            solution: of.to_owned(),
            item: item.to_owned(),
            seed,
        };
        let mut margins = Margins::default();

        for ((variant, _), solution) in self.exhibits.variants.iter().zip(&self.variants) {
            let exam = tasks_and_dependents(&exam, &variant.tasks());
            for item in &exam.items {
                let answers = solution.answers(item).map_err(WorkbenchError::from)?;
                let may_lose = variant.may_lose.contains(&item.id);
                for deviation in deviations::of_correct(item, &answers, may_lose) {
                    margins.add_correct(sighting(deviation, &variant.id, &item.id));
                }
            }
        }

        let mistakes = self.exhibits.mistakes.iter().zip(&self.mistakes);
        for ((mistake, _), solution) in mistakes.filter(|_| with_mistakes) {
            let must_fail = |id: &String| mistake.fails.contains(id);
            let items = exam.items.iter().filter(|item| must_fail(&item.id));
            for item in items {
                let answers = solution.answers(item).map_err(WorkbenchError::from)?;
                let deviation = deviations::of_mistake(item, &answers);
                margins.add_mistake(sighting(deviation, &mistake.id, &item.id));
            }
        }
        Ok(margins)
    }
}

fn progress_bar(count: u64, of: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} {msg}, {eta} left");
    ProgressBar::new(count)
        .with_style(style.expect("a template that was tried"))
        .with_message(of)
}
