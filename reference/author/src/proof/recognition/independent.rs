//! Known mistakes in variants: whether a mistake is recognised in code that is not the reference's.

use std::collections::BTreeSet;
use std::fmt;

use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use super::difference::items_unlike_signature;
use super::{hints, observe};
use crate::proof::ProofError;
use crate::proof::grade::grade_mistake;
use crate::proof::progress::progress_bar;
use crate::solutions::catalogue::Mistake;
use crate::solutions::independent::{IndependentMistake, independent_mistakes};
use crate::solutions::sources::Sources;
use crate::solutions::{Solutions, SolutionsError};

/// How independent mistakes are recognised with one exam.
#[derive(Debug, Default)]
pub struct IndependentRecognition {
    /// Each mistake, and the hints that it gets.
    pub results: Vec<RecognisedIndependent>,
}

/// An independent mistake and its hints.
#[derive(Debug)]
pub struct RecognisedIndependent {
    /// The id of the mistake, and that of the variant that makes it.
    pub name: String,
    /// The hints that are true of it.
    pub true_hints: BTreeSet<String>,
    /// The hints that are false.
    pub false_hints: BTreeSet<String>,
    /// If it is not recognised, the items that it answers unlike the same mistake in the reference.
    pub unlike: Vec<String>,
    /// A message if the code loses no points in its task, or points in another task.
    pub problems: Vec<String>,
}

/// Grades every independent mistake, and determines its hints.
pub fn recognise_independent(
    solutions: &Solutions,
    exam: &Exam,
) -> Result<IndependentRecognition, ProofError> {
    let all = independent_mistakes(solutions).map_err(SolutionsError::from)?;
    let results: Result<Vec<_>, ProofError> = all
        .par_iter()
        .progress_with(progress_bar(all.len() as u64, "mistakes"))
        .filter_map(|(independent, sources)| {
            let mut known = solutions.mistakes.iter();
            let (mistake, _) = known.find(|(mistake, _)| mistake.id == independent.id)?;
            Some(recognise_one(
                solutions,
                exam,
                mistake,
                independent,
                sources,
            ))
        })
        .collect();
    Ok(IndependentRecognition { results: results? })
}

fn recognise_one(
    solutions: &Solutions,
    exam: &Exam,
    mistake: &Mistake,
    independent: &IndependentMistake,
    sources: &Sources,
) -> Result<RecognisedIndependent, ProofError> {
    let IndependentMistake {
        id, variant, also, ..
    } = independent;
    let graded = grade_mistake(&solutions.workbench, mistake, sources, exam)?;
    let problems = graded.task_problems().into_iter();
    let is_true = |hint: &String| {
        let mut made = std::iter::once(id).chain(also);
        made.any(|made| solutions.is_hint_true_of(hint, made))
    };
    let observations = observe(solutions, exam, mistake, sources)?;
    let hints = hints(&observations, exam, mistake).into_iter();
    let (true_hints, false_hints): (BTreeSet<String>, BTreeSet<String>) = hints.partition(is_true);
    let unlike = if true_hints.is_empty() {
        items_unlike_signature(solutions, exam, mistake, sources)?
    } else {
        Vec::new()
    };
    Ok(RecognisedIndependent {
        problems: problems
            .map(|problem| format!("{variant}: {problem}"))
            .collect(),
        name: independent.name(),
        true_hints,
        false_hints,
        unlike,
    })
}

impl RecognisedIndependent {
    /// Returns whether the mistake gets a hint that is true, and none that is false.
    pub fn is_recognised(&self) -> bool {
        !self.true_hints.is_empty() && self.false_hints.is_empty()
    }
}

impl IndependentRecognition {
    /// Returns the mistakes that lose no points in their task, or lose points in another.
    pub fn problems(&self) -> Vec<String> {
        let results = self.results.iter();
        results
            .flat_map(|result| &result.problems)
            .cloned()
            .collect()
    }

    /// Returns the number of mistakes that are recognised.
    pub fn recognised(&self) -> usize {
        let results = self.results.iter();
        results.filter(|result| result.is_recognised()).count()
    }

    /// Returns the number of mistakes with a false hint.
    pub fn with_false_hint(&self) -> usize {
        let results = self.results.iter();
        results
            .filter(|result| !result.false_hints.is_empty())
            .count()
    }

    /// Returns the result as one line.
    pub fn summary_line(&self) -> String {
        let (recognised, count) = (self.recognised(), self.results.len());
        let with_false = self.with_false_hint();
        format!(
            "mistakes in other solutions: {recognised} of {count} recognised ({:.0} %), {} get no \
             hint, {with_false} a false one",
            100.0 * recognised as f64 / count.max(1) as f64,
            count - recognised - with_false,
        )
    }
}

impl fmt::Display for IndependentRecognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for result in &self.results {
            let list =
                |hints: &BTreeSet<String>| Vec::from_iter(hints.iter().cloned()).join(" or ");
            let name = &result.name;
            if !result.false_hints.is_empty() {
                writeln!(f, "{name}: false hint {}", list(&result.false_hints))?;
            } else if result.true_hints.is_empty() {
                let unlike = result.unlike.join(", ");
                writeln!(f, "{name}: no hint; unlike in the reference: {unlike}")?;
            } else {
                writeln!(f, "{name}: recognised")?;
            }
        }
        f.write_str(&self.summary_line())
    }
}
