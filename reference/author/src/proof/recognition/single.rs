//! One mistake at a time, known and left out of the exam.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use judging::exam::Exam;
use rayon::prelude::*;

use super::{hints, observe};
use crate::exams;
use crate::hints::with_hints;
use crate::proof::ProofError;
use crate::seed::Seed;
use crate::solutions::Solutions;

/// How the known mistakes are recognised with one exam, by their ids.
#[derive(Debug, Default)]
pub struct Recognition {
    /// Mistakes that get their hint, possibly together with others that also fit.
    pub recognised: Vec<String>,
    /// Mistakes that do not get their hint, each with those that it gets instead, if any.
    pub misrecognised: Vec<(String, BTreeSet<String>)>,
    /// Mistakes without a signature: only pictures show them, they give no answers, or too many
    /// other mistakes give the same answers.
    pub without_signature: Vec<String>,
    /// Mistakes that would get hints that are not true of them if their own hint were not in the
    /// exam, each with these hints.
    pub confused_when_unknown: Vec<(String, BTreeSet<String>)>,
}

/// Runs every mistake and determines its hints, once with the exam as it is and once without the
/// mistake's own hint.
pub fn recognise(solutions: &Solutions, exam: &Exam) -> Result<Recognition, ProofError> {
    let all: Result<Vec<_>, ProofError> = solutions
        .mistakes
        .par_iter()
        .map(|(mistake, sources)| {
            let observations = observe(solutions, exam, mistake, sources)?;
            let known = hints(&observations, exam, mistake);
            let mut unknown = hints(&observations, &without_hint(exam, &mistake.hint), mistake);
            unknown.retain(|hint| !solutions.is_hint_true_of(hint, &mistake.id));
            Ok((&mistake.id, known, unknown))
        })
        .collect();

    let mut recognition = Recognition::default();
    for (id, known, unknown) in all? {
        let is_own = |hint: &String| solutions.have_same_hint(hint, id);
        if known.iter().any(is_own) {
            recognition.recognised.push(id.clone());
        } else if has_signature(exam, id) {
            recognition.misrecognised.push((id.clone(), known));
        } else {
            recognition.without_signature.push(id.clone());
        }
        if !unknown.is_empty() {
            recognition
                .confused_when_unknown
                .push((id.clone(), unknown));
        }
    }
    Ok(recognition)
}

/// Does the same with the final exams of some seeds, and adds up the results.
pub fn recognise_with_seeds(
    solutions: &Solutions,
    seeds: Range<u64>,
) -> Result<Recognition, ProofError> {
    let mut all = Recognition::default();
    for seed in seeds {
        let exam = exams::generate("final", Seed(seed), &solutions.recorder)?;
        let found = recognise(solutions, &with_hints(exam, solutions)?)?;
        eprintln!("seed {seed}: {}", found.summary_line());
        all.add(found);
    }
    Ok(all)
}

fn has_signature(exam: &Exam, id: &str) -> bool {
    let index = exam.mistakes.iter().position(|mistake| mistake.id == id);
    let signatures = exam.items.iter().map(|item| &item.signatures);
    let mut answers = signatures.flat_map(|signatures| &signatures.mistake_answers);
    index.is_some_and(|index| answers.any(|answers| answers.mistakes.contains(&(index as u32))))
}

/// Returns the exam without the signatures of the mistakes with this hint.
fn without_hint(exam: &Exam, hint: &str) -> Exam {
    let mut exam = exam.clone();
    let mistakes = exam.mistakes.iter();
    let has_hint: Vec<bool> = mistakes.map(|mistake| mistake.hint == hint).collect();
    for answers in exam
        .items
        .iter_mut()
        .flat_map(|item| &mut item.signatures.mistake_answers)
    {
        let mistakes = &mut answers.mistakes;
        mistakes.retain(|&mistake| !has_hint[mistake as usize]);
    }
    exam
}

impl Recognition {
    /// Adds the results of another exam.
    pub fn add(&mut self, other: Recognition) {
        self.recognised.extend(other.recognised);
        self.misrecognised.extend(other.misrecognised);
        self.without_signature.extend(other.without_signature);
        self.confused_when_unknown
            .extend(other.confused_when_unknown);
    }

    /// Returns the fraction of recognised mistakes among those that have a signature.
    pub fn recognised_share(&self) -> f64 {
        let with_signature = self.recognised.len() + self.misrecognised.len();
        self.recognised.len() as f64 / with_signature.max(1) as f64
    }

    /// Returns the result as one line.
    pub fn summary_line(&self) -> String {
        let with_signature = self.recognised.len() + self.misrecognised.len();
        format!(
            "hints: {} of {with_signature} mistakes recognised ({:.0} %), {} more without a \
             signature; when its hint is left out, {} of {} get one that is false",
            self.recognised.len(),
            100.0 * self.recognised_share(),
            self.without_signature.len(),
            self.confused_when_unknown.len(),
            with_signature + self.without_signature.len(),
        )
    }
}

impl fmt::Display for Recognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let list = |hints: &BTreeSet<String>| Vec::from_iter(hints.iter().cloned()).join(" or ");
        for (id, hints) in &self.misrecognised {
            if hints.is_empty() {
                writeln!(f, "{id} gets no hint")?;
            } else {
                writeln!(f, "{id} gets the hint {}", list(hints))?;
            }
        }
        for (id, hints) in &self.confused_when_unknown {
            writeln!(f, "{id}, if unknown, gets the false hint {}", list(hints))?;
        }
        for id in &self.without_signature {
            writeln!(f, "{id} has no signature")?;
        }
        f.write_str(&self.summary_line())
    }
}
