//! Two mistakes at once in one task.

use std::collections::BTreeSet;
use std::fmt;

use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use super::{hints, observe};
use crate::proof::ProofError;
use crate::proof::progress::progress_bar;
use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::WorkbenchError;

/// How pairs of known mistakes are recognised.
#[derive(Debug, Default)]
pub struct PairRecognition {
    /// The number of pairs that get a hint that is true of one or of both together.
    pub with_true_hint: usize,
    /// The pairs that get no hint.
    pub without_hint: Vec<String>,
    /// The pairs that get hints that are true of neither, each with these hints.
    pub false_hints: Vec<(String, BTreeSet<String>)>,
    /// The number of pairs that change the same code, or do not compile together.
    pub impossible: usize,
}

/// Runs pairs of mistakes in the same task, and determines their hints: all pairs, or the given
/// number of them, spread evenly.
pub fn recognise_pairs(
    solutions: &Solutions,
    exam: &Exam,
    reference: &Sources,
    count: Option<usize>,
) -> Result<PairRecognition, ProofError> {
    let mistakes = || solutions.mistakes.iter().map(|(mistake, _)| mistake);
    let pairs = mistakes().enumerate().flat_map(|(index, one)| {
        let later = mistakes().skip(index + 1);
        later
            .filter(|other| other.task() == one.task())
            .map(move |other| (one, other))
    });
    let pairs: Vec<_> = pairs.collect();
    let chosen = count.map_or(pairs.len(), |count| count.clamp(1, pairs.len()));
    let pairs: Vec<_> = (0..chosen)
        .map(|index| pairs[index * pairs.len() / chosen])
        .collect();
    let results: Result<Vec<_>, ProofError> = pairs
        .par_iter()
        .progress_with(progress_bar(pairs.len() as u64, "pairs"))
        .map(|&(one, other)| recognise_pair(solutions, exam, reference, one, other))
        .collect();

    let mut recognition = PairRecognition::default();
    for ((one, other), outcome) in pairs.into_iter().zip(results?) {
        match outcome {
            None => recognition.impossible += 1,
            Some(hints) => {
                let ids = [one.id.as_str(), other.id.as_str()];
                let is_true = |hint: &String| solutions.is_hint_true_of_pair(hint, ids);
                let (fits, others): (BTreeSet<String>, _) = hints.into_iter().partition(is_true);
                recognition.with_true_hint += usize::from(!fits.is_empty());
                let pair = || format!("{} with {}", one.id, other.id);
                if !others.is_empty() {
                    recognition.false_hints.push((pair(), others));
                } else if fits.is_empty() {
                    recognition.without_hint.push(pair());
                }
            }
        }
    }
    Ok(recognition)
}

/// Returns the hints for two mistakes, or `None` if there is no code that has both.
fn recognise_pair(
    solutions: &Solutions,
    exam: &Exam,
    reference: &Sources,
    one: &Mistake,
    other: &Mistake,
) -> Result<Option<BTreeSet<String>>, ProofError> {
    let both = one.apply(reference).and_then(|both| other.apply(&both));
    let Ok(sources) = both else {
        return Ok(None);
    };
    match observe(solutions, exam, one, &sources) {
        Ok(observations) => Ok(Some(hints(&observations, exam, one))),
        Err(ProofError::Workbench(WorkbenchError::NotCompiled { .. })) => Ok(None),
        Err(error) => Err(error),
    }
}

impl PairRecognition {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        format!(
            "pairs: {} get a true hint, {} no hint, {} a false one; {} change the same code",
            self.with_true_hint,
            self.without_hint.len(),
            self.false_hints.len(),
            self.impossible,
        )
    }
}

impl fmt::Display for PairRecognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for pair in &self.without_hint {
            writeln!(f, "{pair} get no hint")?;
        }
        for (pair, hints) in &self.false_hints {
            let hints = Vec::from_iter(hints.iter().cloned()).join(" or ");
            writeln!(f, "{pair} get the false hint {hints}")?;
        }
        f.write_str(&self.summary_line())
    }
}
