//! Measures the quality of hints: whether known mistakes are recognised, alone, in pairs and in
//! other solutions, and whether an unknown mistake gets a hint that is not true of it.

mod difference;
mod independent;
mod pairs;
mod single;
mod unknown;

use std::collections::BTreeSet;

use grader::probe::Fault;
use judging::exam::Exam;
use judging::recognise::Observations;

pub use independent::{IndependentRecognition, RecognisedIndependent, recognise_independent};
pub use pairs::{PairRecognition, recognise_pairs};
pub use single::{Recognition, recognise, recognise_with_seeds};
pub use unknown::{UnknownRecognition, recognise_unknown};

use crate::proof::ProofError;
use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::WorkbenchError;

/// Runs a solution on the items of a mistake's task, and records its answers.
fn observe(
    solutions: &Solutions,
    exam: &Exam,
    mistake: &Mistake,
    sources: &Sources,
) -> Result<Observations, ProofError> {
    let solution = solutions.workbench.build(sources, &mistake.id)?;
    let mut observations = Observations::default();
    let items = exam.items.iter().filter(|item| item.task == mistake.task());
    for item in items {
        let answers = solution.answers(item).map_err(WorkbenchError::from)?;
        observations.record(item, answers.as_deref().map_err(Fault::no_answer_reason));
    }
    Ok(observations)
}

/// Returns the ids of the mistakes whose hints appear at any item of a mistake's task.
fn hints(observations: &Observations, exam: &Exam, mistake: &Mistake) -> BTreeSet<String> {
    let items = exam.items.iter().filter(|item| item.task == mistake.task());
    let hints = items.flat_map(|item| observations.explain(exam, item));
    hints.map(|hint| hint.id.clone()).collect()
}
