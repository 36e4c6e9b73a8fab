//! Measures the quality of hints: whether each known mistake is recognised, and whether an unknown
//! mistake is confused with a known one.

use std::fmt;

use grader::probe::Fault;
use judging::exam::{Exam, Item};
use judging::recognise::Observations;
use rayon::prelude::*;

use crate::proof::ProofError;
use crate::solutions::Solutions;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::WorkbenchError;

/// The ids of the known mistakes, grouped by whether the exam recognises each mistake and gives its
/// hint.
#[derive(Debug, Default)]
pub struct Recognition {
    /// Mistakes that are recognised: their hint is given, possibly together with other hints that
    /// also fit.
    pub recognised: Vec<String>,
    /// Mistakes whose own hint is not given, each with the hints that are given instead, if any.
    pub misrecognised: Vec<(String, Vec<String>)>,
    /// Mistakes without a signature: only pictures show them, they give no answers, or too many
    /// other mistakes give the same answers.
    pub without_signature: Vec<String>,
    /// Mistakes that would get hints for other mistakes if they were not in the catalogue, each
    /// with these hints.
    pub confused_when_unknown: Vec<(String, Vec<String>)>,
}

/// Runs every mistake and determines its hints, once with the exam as it is and once without the
/// mistake's signature.
pub fn recognise(solutions: &Solutions, exam: &Exam) -> Result<Recognition, ProofError> {
    let indices: Vec<usize> = (0..solutions.mistakes.len()).collect();
    let all: Result<Vec<_>, ProofError> = indices
        .par_iter()
        .map(|&index| {
            let (mistake, sources) = &solutions.mistakes[index];
            let observations = observe(solutions, exam, &mistake.id, sources)?;
            let hints = first_hints(&observations, exam, index, exam);
            let without = first_hints(
                &observations,
                &without_mistake(exam, index as u32),
                index,
                exam,
            );
            Ok((mistake.id.clone(), hints, without.unwrap_or_default()))
        })
        .collect();

    let mut recognition = Recognition::default();
    for (id, hints, without) in all? {
        match hints {
            None => recognition.without_signature.push(id.clone()),
            Some(hints) if hints.contains(&id) => recognition.recognised.push(id.clone()),
            Some(hints) => recognition.misrecognised.push((id.clone(), hints)),
        }
        if !without.is_empty() {
            recognition.confused_when_unknown.push((id, without));
        }
    }
    Ok(recognition)
}

/// Runs a solution on the items of its task, and records its answers.
fn observe(
    solutions: &Solutions,
    exam: &Exam,
    id: &str,
    sources: &Sources,
) -> Result<Observations, ProofError> {
    let solution = solutions.workbench.build(sources, id)?;
    let mut observations = Observations::default();
    let task = id.split('.').next();
    for item in exam
        .items
        .iter()
        .filter(|item| Some(item.task.id()) == task)
    {
        let answers = solution.answers(item).map_err(WorkbenchError::from)?;
        observations.record(item, answers.as_deref().map_err(Fault::no_answer_reason));
    }
    Ok(observations)
}

/// Returns the hints at the first item for which `known` has a signature of this mistake, or `None`
/// if there is no such item.
fn first_hints(
    observations: &Observations,
    exam: &Exam,
    mistake: usize,
    known: &Exam,
) -> Option<Vec<String>> {
    let mistake = mistake as u32;
    let fails = |item: &Item| {
        item.signatures
            .mistake_answers
            .iter()
            .any(|answers| answers.mistakes.contains(&mistake))
    };
    let index = known.items.iter().position(fails)?;
    let hints = observations.explain(exam, &exam.items[index]);
    Some(hints.iter().map(|hint| hint.id.clone()).collect())
}

/// Returns the exam without the signatures of this mistake.
fn without_mistake(exam: &Exam, mistake: u32) -> Exam {
    let mut exam = exam.clone();
    for answers in exam
        .items
        .iter_mut()
        .flat_map(|item| &mut item.signatures.mistake_answers)
    {
        answers.mistakes.retain(|other| *other != mistake);
    }
    exam
}

impl Recognition {
    /// Returns the fraction of recognised mistakes among those that have a signature.
    pub fn recognised_share(&self) -> f64 {
        let with_signature = self.recognised.len() + self.misrecognised.len();
        self.recognised.len() as f64 / with_signature.max(1) as f64
    }
}

impl fmt::Display for Recognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (id, hints) in &self.misrecognised {
            let hints = if hints.is_empty() {
                "no hint".to_owned()
            } else {
                format!("the hint {}", hints.join(" or "))
            };
            writeln!(f, "{id} gets {hints}")?;
        }
        for (id, hints) in &self.confused_when_unknown {
            writeln!(f, "{id}, if unknown, gets the hint {}", hints.join(" or "))?;
        }
        writeln!(
            f,
            "without a signature: {}",
            self.without_signature.join(", ")
        )?;
        let with_signature = self.recognised.len() + self.misrecognised.len();
        write!(
            f,
            "hints: {} of {with_signature} mistakes recognised ({:.0} %), {} more without a \
             signature; when removed from the catalogue one at a time, {} of {} get a hint for \
             another mistake",
            self.recognised.len(),
            100.0 * self.recognised_share(),
            self.without_signature.len(),
            self.confused_when_unknown.len(),
            with_signature + self.without_signature.len(),
        )
    }
}
