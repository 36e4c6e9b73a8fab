//! Wrong solutions of no known kind: whether they get a hint that is not true of them.

use std::collections::BTreeSet;
use std::fmt;

use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use super::{hints, observe};
use crate::proof::ProofError;
use crate::proof::grade::grade_mistake;
use crate::proof::progress::progress_bar;
use crate::solutions::sources::Sources;
use crate::solutions::unknown::unknown_mistakes;
use crate::solutions::{Solutions, SolutionsError};

/// The hints that unknown mistakes get with one exam.
#[derive(Debug, Default)]
pub struct UnknownRecognition {
    /// Each mistake by its id, with the hints that are not true of it.
    pub false_hints: Vec<(String, BTreeSet<String>)>,
    /// A message if the code loses no points in its task, or points in another task.
    pub problems: Vec<String>,
}

/// Grades every unknown mistake, and determines its hints.
pub fn recognise_unknown(
    solutions: &Solutions,
    exam: &Exam,
    reference: &Sources,
) -> Result<UnknownRecognition, ProofError> {
    let all = unknown_mistakes(solutions, reference).map_err(SolutionsError::from)?;
    let results: Result<Vec<_>, ProofError> = all
        .par_iter()
        .progress_with(progress_bar(all.len() as u64, "mistakes"))
        .map(|(unknown, mistake, sources)| {
            let graded = grade_mistake(&solutions.workbench, mistake, sources, exam)?;
            let observations = observe(solutions, exam, mistake, sources)?;
            let is_true = |hint: &String| {
                let mut true_hints = unknown.true_hints.iter();
                true_hints.any(|known| solutions.is_hint_true_of(hint, known))
            };
            let mut hints = hints(&observations, exam, mistake);
            hints.retain(|hint| !is_true(hint));
            Ok((unknown.id.clone(), hints, graded.task_problems()))
        })
        .collect();

    let mut recognition = UnknownRecognition::default();
    for (id, hints, problems) in results? {
        recognition.false_hints.push((id, hints));
        recognition.problems.extend(problems);
    }
    Ok(recognition)
}

impl UnknownRecognition {
    /// Returns the number of mistakes that get a hint that is not true of them.
    pub fn misled(&self) -> usize {
        let mistakes = self.false_hints.iter();
        mistakes.filter(|(_, hints)| !hints.is_empty()).count()
    }

    /// Returns the result as one line.
    pub fn summary_line(&self) -> String {
        let count = self.false_hints.len();
        format!(
            "mistakes of no known kind: {count}, {} get a hint that is false",
            self.misled()
        )
    }
}

impl fmt::Display for UnknownRecognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let misled = self.false_hints.iter();
        for (id, hints) in misled.filter(|(_, hints)| !hints.is_empty()) {
            let hints = Vec::from_iter(hints.iter().cloned()).join(" or ");
            writeln!(f, "{id}: false hint {hints}")?;
        }
        f.write_str(&self.summary_line())
    }
}
