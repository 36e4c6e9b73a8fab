//! A graded class: what all of its files are made of.

use grader::policy::{Counted, Policy};

use crate::entry::Person;
use crate::late::{counted, is_undated};
use crate::outcome::{Outcome, Row, Told};

/// A graded class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Class {
    /// The exam's name.
    pub exam: String,
    /// Of its bytes.
    pub exam_hash: String,
    /// How submissions were kept apart from the machine.
    pub isolation: String,
    /// One for each submission, in the order of their ids.
    pub lines: Vec<Line>,
    /// Those of the lists who have handed in nothing.
    pub missing: Vec<Person>,
}

/// A submission, and what it counts for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What became of it.
    pub row: Row,
    /// What it counts for; none without a score.
    pub counted: Option<Counted>,
    /// Whether it counts as in time because nobody knows when it came.
    pub is_undated: bool,
}

impl Class {
    /// The scores.
    pub fn scores(&self) -> impl Iterator<Item = (&Row, &Told)> {
        let rows = self.lines.iter().map(|line| &line.row);
        rows.filter_map(|row| Some((row, row.score()?)))
    }

    /// Those that have to be graded again.
    pub fn faults(&self) -> usize {
        let is_fault = |line: &&Line| matches!(line.row.outcome, Outcome::Fault(_));
        self.lines.iter().filter(is_fault).count()
    }
}

impl Line {
    /// What the policy makes of it.
    pub fn of(row: Row, policy: &Policy) -> Self {
        let counted = row.score().map(|score| counted(policy, &row.about, score));
        let is_undated = counted.is_some() && is_undated(policy, &row.about);
        Line {
            row,
            counted,
            is_undated,
        }
    }

    /// In a word, for tables.
    pub fn status(&self) -> &'static str {
        match &self.row.outcome {
            Outcome::Graded(_) => "graded",
            Outcome::NoSubmission(_) => "nothing to grade",
            Outcome::Fault(_) => "not graded",
        }
    }

    /// Why there is no score. Empty if there is one.
    pub fn why(&self) -> &str {
        match &self.row.outcome {
            Outcome::Graded(_) => "",
            Outcome::NoSubmission(why) | Outcome::Fault(why) => why,
        }
    }
}
