//! Checks that the exam catches every mechanical change to the reference's task files. Each mutant
//! must lose points unless it is equivalent to the reference.

pub mod findings;

use anyhow::{Result, bail};
use grader::task_selection::TaskSelection;

use crate::authoring::Authoring;
use crate::exams;
use crate::proof::mutants::findings::{Findings, MutantOutcome};
use crate::proof::run::run_compiled;
use crate::solutions::mutants::equivalent::equivalent_mutants;
use crate::solutions::mutants::mutants;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::Workbench;

/// The step of a sample, which contains every eighth mutant in the order of their names.
pub const SAMPLE_STEP: usize = 8;

/// Builds every `step`-th mutant of some tasks and grades each with the practice exam.
pub fn run(authoring: &'static Authoring, tasks: &TaskSelection, step: usize) -> Result<Findings> {
    let workbench = Workbench::open(authoring)?;
    let handed_out = authoring.handed_out;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let exam = exams::load_practice(workbench.root(), authoring)?;
    let score = workbench.build(&reference, "reference")?.score(&exam)?;
    if score.points < score.max_points {
        // Otherwise, a mutant's loss of points would prove nothing.
        bail!("the reference itself loses points: run `cargo grade reference`");
    }

    let all = mutants(&reference)?;
    let of_tasks = all.iter().filter(|mutant| {
        let mut own = mutant.expected.tasks.iter();
        own.any(|&task| tasks.includes(task))
    });
    let sample = of_tasks.step_by(step);
    let graded = run_compiled(&workbench, sample, "mutants", |mutant, built| {
        let score = built.map(|built| built.score(&exam)).transpose()?;
        let outcome = match score {
            None => MutantOutcome::NotCompiled,
            Some(score) if score.points < score.max_points => MutantOutcome::Caught,
            Some(_) => MutantOutcome::Survived,
        };
        Ok((mutant.id.clone(), outcome))
    })?;
    let skipped = all.iter();
    let skipped = skipped.map(|mutant| (mutant.id.clone(), MutantOutcome::Skipped));
    Ok(Findings {
        outcomes: skipped.chain(graded).collect(),
        equivalent: equivalent_mutants(workbench.root(), handed_out)?,
    })
}
