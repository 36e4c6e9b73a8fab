//! Known mistakes in variants: whether a mistake is recognised in code that is not the reference's.

use std::collections::BTreeSet;
use std::fmt;

use grader::clue::KEPT_STATE;
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
    /// Whether it keeps state and the report says so, or neither.
    pub state: StateNamed,
    /// The hints that are false.
    pub false_hints: BTreeSet<String>,
    /// If it is not recognised, the items that it answers unlike the same mistake in the reference.
    pub unlike: Vec<String>,
    /// A message if the code loses no points in its task, or points in another task.
    pub problems: Vec<String>,
}

/// Whether the report names state that is kept between calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateNamed {
    /// The code keeps state, and the report says so.
    Rightly,
    /// The code keeps none, but the report says so.
    Wrongly,
    /// The report does not say so.
    No,
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
    let mut clues = graded.score.items().filter_map(|item| item.clue.as_deref());
    let state = match (clues.any(|clue| clue == KEPT_STATE), mistake.keeps_state()) {
        (true, true) => StateNamed::Rightly,
        (true, false) => StateNamed::Wrongly,
        (false, _) => StateNamed::No,
    };
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
        state,
        false_hints,
        unlike,
    })
}

impl RecognisedIndependent {
    /// Returns whether the report says something about the mistake that is true, and nothing that is
    /// false.
    pub fn is_recognised(&self) -> bool {
        let is_named = !self.true_hints.is_empty() || self.state == StateNamed::Rightly;
        is_named && !self.is_misled()
    }

    /// Returns whether the report says something false about the mistake.
    pub fn is_misled(&self) -> bool {
        !self.false_hints.is_empty() || self.state == StateNamed::Wrongly
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

    /// Returns the number of mistakes about which the report says something false.
    pub fn misled(&self) -> usize {
        let results = self.results.iter();
        results.filter(|result| result.is_misled()).count()
    }

    /// Returns the result as one line.
    pub fn summary_line(&self) -> String {
        let (recognised, count) = (self.recognised(), self.results.len());
        let misled = self.misled();
        format!(
            "mistakes in other solutions: {recognised} of {count} recognised ({:.0} %), {} get no \
             hint, {misled} a false one",
            100.0 * recognised as f64 / count.max(1) as f64,
            count - recognised - misled,
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
            } else if result.state == StateNamed::Wrongly {
                writeln!(f, "{name}: said to keep state, which it does not")?;
            } else if !result.is_recognised() {
                let unlike = result.unlike.join(", ");
                writeln!(f, "{name}: no hint; unlike in the reference: {unlike}")?;
            } else {
                writeln!(f, "{name}: recognised")?;
            }
        }
        f.write_str(&self.summary_line())
    }
}
