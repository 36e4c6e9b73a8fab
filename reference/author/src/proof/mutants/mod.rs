//! Checks that the exam catches every mechanical change to the reference's task files. Each must lose
//! points, except those that are equivalent to the reference.

pub mod findings;

use anyhow::{Result, bail};
use grader::handed_out::HandedOut;

use crate::exams;
use crate::proof::mutants::findings::{Findings, MutantOutcome};
use crate::proof::run::run_compiled;
use crate::solutions::mutants::equivalent::equivalent_mutants;
use crate::solutions::mutants::mutants;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::Workbench;

/// The step of a sample: it contains one in this many mutants, in the order of their names.
pub const SAMPLE_STEP: usize = 8;

/// Builds all mutants, or one in `step`, and grades each with the practice exam.
pub fn run(handed_out: &'static HandedOut, step: usize) -> Result<Findings> {
    let workbench = Workbench::open(handed_out)?;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let exam = exams::load_practice(workbench.root())?;
    let score = workbench.build(&reference, "reference")?.score(&exam)?;
    if score.points < score.max_points {
        // A mutant's loss of points would prove nothing.
        bail!("the reference itself loses points: run `cargo grade reference`");
    }

    let all = mutants(&reference)?;
    let sample = all.iter().step_by(step);
    let scores = run_compiled(&workbench, sample, "mutants", |_, built| built.score(&exam))?;
    let skipped = all.iter().map(|mutant| (mutant, MutantOutcome::Skipped));
    let graded = scores.into_iter().map(|(mutant, score)| {
        let outcome = match score {
            None => MutantOutcome::NotCompiled,
            Some(score) if score.points < score.max_points => MutantOutcome::Caught,
            Some(_) => MutantOutcome::Survived,
        };
        (mutant, outcome)
    });
    Ok(Findings {
        outcomes: skipped
            .chain(graded)
            .map(|(mutant, outcome)| (mutant.id.clone(), outcome))
            .collect(),
        equivalent: equivalent_mutants(workbench.root())?,
    })
}
