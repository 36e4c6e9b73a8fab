//! Measures the quality of hints: whether known mistakes are recognised individually, in pairs and
//! in other solutions, and whether unknown mistakes get false hints.

mod catalogue;
mod known;

use std::collections::BTreeSet;
use std::fmt;

use anyhow::Result;
use grader::probe::Fault;
use judging::exam::{Exam, Item};
use judging::recognise::Observations;

pub use catalogue::{recognise_independent, recognise_unknown};
pub use known::{recognise, recognise_pairs, recognise_with_seeds};

use crate::solutions::solution::Solution;
use crate::solutions::workbench::{Answers, BuiltSolution};

/// How well solutions are recognised, judging by the hints they get.
#[derive(Debug, Default)]
pub struct Recognition {
    /// The number of solutions that can be recognised.
    pub count: usize,
    /// The number of solutions that get a true hint and no false hint.
    pub recognised: usize,
    /// The number of solutions that get a false hint. For a known mistake, its own hint is removed
    /// first.
    pub with_false_hint: usize,
    /// The solutions that lose no points in their task or lose points in another task, one line
    /// each.
    pub problems: Vec<String>,
    /// The solutions worth listing, one line each.
    pub lines: Vec<String>,
    /// The result as one line.
    pub summary_line: String,
}

impl fmt::Display for Recognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for line in &self.lines {
            writeln!(f, "{line}")?;
        }
        f.write_str(&self.summary_line)
    }
}

/// Runs a solution on the items of its task, each in a new process.
fn answers<'e>(
    solution: &Solution,
    built: &BuiltSolution,
    exam: &'e Exam,
) -> Result<Vec<(&'e Item, Answers)>> {
    let items = exam.items.iter();
    let items = items.filter(|item| item.task == solution.task());
    items.map(|item| Ok((item, built.answers(item)?))).collect()
}

/// Returns the ids of the mistakes whose hints these answers trigger in at least one item. `exam`
/// is the exam that contains the items; some of its hints may have been removed.
fn hints(answers: &[(&Item, Answers)], exam: &Exam) -> BTreeSet<String> {
    let mut observations = Observations::default();
    for (item, answers) in answers {
        observations.record(item, answers.as_deref().map_err(Fault::no_answer_reason));
    }
    let is_answered = |item: &&Item| answers.iter().any(|(other, _)| other.id == item.id);
    let items = exam.items.iter().filter(is_answered);
    let hints = items.flat_map(|item| observations.explain(exam, item));
    hints.map(|hint| hint.id.clone()).collect()
}

/// Formats the ids of hints for use in a sentence.
fn list(hints: &BTreeSet<String>) -> String {
    Vec::from_iter(hints.iter().cloned()).join(" or ")
}
