//! How well hints are given: whether each known mistake is recognised, and whether a mistake that
//! is not known is taken for another.

use std::fmt;

use grader::exam::{Exam, Item};
use grader::probe::Fault;
use grader::recognise::Observations;
use rayon::prelude::*;

use crate::proof::solutions::{ProofError, Solutions};
use crate::proof::sources::Sources;
use crate::proof::workbench::WorkbenchError;

/// What was found out, of all mistakes.
#[derive(Debug, Default)]
pub struct Recognition {
    /// Recognised: it is the first hint, or one of several that nothing tells apart.
    pub recognised: Vec<String>,
    /// Taken for another, or for none: its hints.
    pub misrecognised: Vec<(String, Vec<String>)>,
    /// Nothing is told of it: only pictures show it, or it is mute, or like too many others.
    pub without_signature: Vec<String>,
    /// Left out of the catalogue, and taken for these.
    pub confused_when_unknown: Vec<(String, Vec<String>)>,
}

/// Asks every mistake, and what the exam would say of it: as it is, and had it not known of it.
pub fn recognise(exhibits: &Solutions, exam: &Exam) -> Result<Recognition, ProofError> {
    let places: Vec<usize> = (0..exhibits.mistakes.len()).collect();
    let all: Result<Vec<_>, ProofError> = places
        .par_iter()
        .map(|&place| {
            let (mistake, sources) = &exhibits.mistakes[place];
            let sightings = observe(exhibits, exam, &mistake.id, sources)?;
            let hints = first_hints(&sightings, exam, place, exam);
            let without = first_hints(
                &sightings,
                &without_mistake(exam, place as u32),
                place,
                exam,
            );
            Ok((mistake.id.clone(), hints, without.unwrap_or_default()))
        })
        .collect();

    let mut found = Recognition::default();
    for (id, hints, without) in all? {
        match hints {
            None => found.without_signature.push(id.clone()),
            Some(hints) if hints.contains(&id) => found.recognised.push(id.clone()),
            Some(hints) => found.misrecognised.push((id.clone(), hints)),
        }
        if !without.is_empty() {
            found.confused_when_unknown.push((id, without));
        }
    }
    Ok(found)
}

fn observe(
    exhibits: &Solutions,
    exam: &Exam,
    id: &str,
    sources: &Sources,
) -> Result<Observations, ProofError> {
    let solution = exhibits.workbench.build(sources, id)?;
    let mut sightings = Observations::default();
    let task = id.split('.').next();
    for item in exam
        .items
        .iter()
        .filter(|item| Some(item.task.id()) == task)
    {
        let answers = solution.answers(item).map_err(WorkbenchError::from)?;
        sightings.record(item, answers.as_deref().map_err(Fault::no_answer_reason));
    }
    Ok(sightings)
}

/// The hints at the first item of which `known` tells that this mistake gets it wrong; none if
/// there is no such item.
fn first_hints(
    sightings: &Observations,
    exam: &Exam,
    mistake: usize,
    known: &Exam,
) -> Option<Vec<String>> {
    let mistake = mistake as u32;
    let fails = |item: &Item| {
        item.signatures
            .mistake_answers
            .iter()
            .any(|told| told.mistakes.contains(&mistake))
    };
    let place = known.items.iter().position(fails)?;
    let hints = sightings.explain(exam, &exam.items[place]);
    Some(hints.iter().map(|hint| hint.id.clone()).collect())
}

/// The exam, had nobody known of this mistake.
fn without_mistake(exam: &Exam, mistake: u32) -> Exam {
    let mut exam = exam.clone();
    for told in exam
        .items
        .iter_mut()
        .flat_map(|item| &mut item.signatures.mistake_answers)
    {
        told.mistakes.retain(|other| *other != mistake);
    }
    exam
}

impl Recognition {
    /// Of those of which something is told, how many are recognised.
    pub fn recognised_share(&self) -> f64 {
        let told = self.recognised.len() + self.misrecognised.len();
        self.recognised.len() as f64 / told.max(1) as f64
    }
}

impl fmt::Display for Recognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (id, hints) in &self.misrecognised {
            let hints = match hints.is_empty() {
                true => "none".to_owned(),
                false => hints.join(" or "),
            };
            writeln!(f, "{id} is taken for {hints}")?;
        }
        for (id, hints) in &self.confused_when_unknown {
            writeln!(f, "{id}, left out, is taken for {}", hints.join(" or "))?;
        }
        writeln!(
            f,
            "told by pictures alone: {}",
            self.without_signature.join(", ")
        )?;
        let told = self.recognised.len() + self.misrecognised.len();
        write!(
            f,
            "hints: {} of {told} mistakes recognised ({:.0} %), {} of which nothing is told; left \
             out one at a time, {} of {} are taken for another",
            self.recognised.len(),
            100.0 * self.recognised_share(),
            self.without_signature.len(),
            self.confused_when_unknown.len(),
            told + self.without_signature.len(),
        )
    }
}
