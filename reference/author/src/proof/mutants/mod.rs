//! Checks that the exam catches every mechanical change to the reference's task files. Each must lose
//! points, except those that are equivalent to the reference.

pub mod findings;

use grader::exam_source::ExamSourceError;
use grader::files::PathError;
use grader::handed_out::HandedOut;
use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use crate::exams;
use crate::proof::mutants::findings::{Findings, MutantOutcome};
use crate::proof::progress::progress_bar;
use crate::solutions::mutants::equivalent::{EquivalentsError, equivalent_mutants};
use crate::solutions::mutants::mutants;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::{Workbench, WorkbenchError};

/// The step of a sample: it contains one in this many mutants, in the order of their names.
pub const SAMPLE_STEP: usize = 8;

/// The reason why the mutants cannot be graded.
#[derive(Debug, thiserror::Error)]
pub enum MutantsError {
    /// A file of the reference cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// A file of the reference is not Rust code.
    #[error("cannot parse the reference: {0}")]
    Syntax(#[from] syn::Error),
    /// The list of equivalent mutants cannot be used.
    #[error(transparent)]
    Equivalents(#[from] EquivalentsError),
    /// The practice exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
    /// A mutant cannot be built or run.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The reference itself loses points, so a mutant's loss of points would prove nothing.
    #[error("the reference itself loses points: run `cargo grade reference`")]
    Reference,
}

/// Builds all mutants, or one in `step`, and grades each with the practice exam.
pub fn run(handed_out: &'static HandedOut, step: usize) -> Result<Findings, MutantsError> {
    let workbench = Workbench::open(handed_out)?;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let exam = exams::load_practice(workbench.root())?;
    if outcome(&workbench, &reference, "reference", &exam)? != MutantOutcome::Survived {
        return Err(MutantsError::Reference);
    }

    let all = mutants(handed_out, &reference)?;
    let bar = progress_bar(all.len() as u64, "mutants");
    let outcomes: Result<_, WorkbenchError> = all
        .into_par_iter()
        .enumerate()
        .progress_with(bar)
        .map(|(number, (name, sources))| {
            let outcome = if number.is_multiple_of(step) {
                outcome(&workbench, &sources, &name, &exam)?
            } else {
                MutantOutcome::Skipped
            };
            Ok((name, outcome))
        })
        .collect();
    Ok(Findings {
        outcomes: outcomes?,
        equivalent: equivalent_mutants(workbench.root())?,
    })
}

/// Builds and grades one mutant.
fn outcome(
    workbench: &Workbench,
    sources: &Sources,
    name: &str,
    exam: &Exam,
) -> Result<MutantOutcome, WorkbenchError> {
    let solution = match workbench.build(sources, name) {
        Err(WorkbenchError::NotCompiled { .. }) => return Ok(MutantOutcome::NotCompiled),
        built => built?,
    };
    let score = solution.score(exam)?;
    Ok(if score.points < score.max_points {
        MutantOutcome::Caught
    } else {
        MutantOutcome::Survived
    })
}
