//! The runner of all solutions: builds each of them, and asks it.

use anyhow::Result;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;

use crate::proof::progress::progress_bar;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::{BuiltSolution, NotCompiledError, Workbench};

/// Builds solutions and returns each with what `ask` returns for its program. A solution that does not
/// compile is an error. `unit` is shown with the progress.
pub(super) fn run<'a, R: Send>(
    workbench: &Workbench,
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution, BuiltSolution) -> Result<R> + Sync,
) -> Result<Vec<(&'a Solution, R)>> {
    in_parallel(solutions, unit, |solution| {
        ask(solution, workbench.build(&solution.sources, &solution.id)?)
    })
}

/// Does the same with solutions that need not compile. If one does not, its result is `None`.
pub(super) fn run_compiled<'a, R: Send>(
    workbench: &Workbench,
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution, BuiltSolution) -> Result<R> + Sync,
) -> Result<Vec<(&'a Solution, Option<R>)>> {
    in_parallel(solutions, unit, |solution| {
        match workbench.build(&solution.sources, &solution.id) {
            Err(error) if error.is::<NotCompiledError>() => Ok(None),
            built => ask(solution, built?).map(Some),
        }
    })
}

fn in_parallel<'a, R: Send>(
    solutions: impl IntoIterator<Item = &'a Solution>,
    unit: &'static str,
    ask: impl Fn(&'a Solution) -> Result<R> + Sync,
) -> Result<Vec<(&'a Solution, R)>> {
    let solutions: Vec<&Solution> = solutions.into_iter().collect();
    let bar = progress_bar(solutions.len() as u64, unit);
    let rows = solutions.into_par_iter().progress_with(bar);
    rows.map(|solution| Ok((solution, ask(solution)?)))
        .collect()
}
