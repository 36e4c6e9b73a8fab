//! Builds all solutions and runs them on exams. Also generates the exams for many seeds. Both take
//! a long time, so they show progress bars.

use std::ops::Range;

use anyhow::Result;
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use judging::exam::Exam;
use rayon::prelude::*;

use crate::exams;
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::{BuiltSolution, NotCompiledError, Workbench};

/// Builds solutions, calls `ask` with each and returns the results. Fails if a solution doesn't
/// compile. `unit` is shown with the progress.
pub(super) fn run<'a, R: Send>(
    workbench: &Workbench,
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution, BuiltSolution) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    in_parallel(solutions, unit, |solution| {
        ask(solution, workbench.build(&solution.sources, &solution.id)?)
    })
}

/// Like [`run`], for solutions that may not compile. If a solution doesn't compile, `ask` gets
/// `None`.
pub(super) fn run_compiled<'a, R: Send>(
    workbench: &Workbench,
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution, Option<BuiltSolution>) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    in_parallel(solutions, unit, |solution| {
        match workbench.build(&solution.sources, &solution.id) {
            Err(error) if error.is::<NotCompiledError>() => ask(solution, None),
            built => ask(solution, Some(built?)),
        }
    })
}

fn in_parallel<'a, R: Send>(
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    let solutions: Vec<&Solution> = solutions.into_iter().collect();
    let bar = progress_bar(solutions.len() as u64, unit);
    let solutions = solutions.into_par_iter().progress_with(bar);
    solutions.map(ask).collect()
}

/// Calls `ask` with each seed and returns the results.
pub(super) fn for_seeds<R: Send>(
    seeds: Range<u64>,
    ask: impl Fn(u64) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    let bar = progress_bar(seeds.end - seeds.start, "seeds");
    seeds.into_par_iter().progress_with(bar).map(ask).collect()
}

/// Generates the exam for a seed, without hints.
pub(super) fn exam_of(solutions: &Solutions, seed: u64) -> Result<Exam> {
    exams::generate("proof", Seed(seed), solutions)
}

/// Returns a progress bar from 0 to `count`. `unit` names the things that are counted, e.g.
/// "seeds".
fn progress_bar(count: u64, unit: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} {msg}, {eta} left");
    ProgressBar::new(count)
        .with_style(style.expect("the template is valid"))
        .with_message(unit)
}
