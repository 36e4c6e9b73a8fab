//! A graded class: what all of its files are made of.

use grader::policy::{CountedPoints, Policy};

use crate::entry::Person;
use crate::late::{apply_policy, is_undated};
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary};

/// A graded class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GradedClass {
    /// The exam's name.
    pub exam: String,
    /// Of its bytes.
    pub exam_hash: String,
    /// How submissions were kept apart from the machine.
    pub isolation: String,
    /// One for each submission, in the order of their ids.
    pub rows: Vec<ClassRow>,
    /// Those of the lists who have handed in nothing.
    pub missing: Vec<Person>,
}

/// A submission, and what it counts for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassRow {
    /// What became of it.
    pub result: EntryResult,
    /// What it counts for; none without a score.
    pub counted: Option<CountedPoints>,
    /// Whether it counts as in time because nobody knows when it came.
    pub is_undated: bool,
}

impl GradedClass {
    /// The scores.
    pub fn scores(&self) -> impl Iterator<Item = (&EntryResult, &ScoreSummary)> {
        let rows = self.rows.iter().map(|line| &line.result);
        rows.filter_map(|row| Some((row, row.score()?)))
    }

    /// Those that have to be graded again.
    pub fn fault_count(&self) -> usize {
        let is_fault = |line: &&ClassRow| matches!(line.result.outcome, EntryOutcome::Fault(_));
        self.rows.iter().filter(is_fault).count()
    }
}

impl ClassRow {
    /// What the policy makes of it.
    pub fn new(row: EntryResult, policy: &Policy) -> Self {
        let counted = row
            .score()
            .map(|score| apply_policy(policy, &row.info, score));
        let is_undated = counted.is_some() && is_undated(policy, &row.info);
        ClassRow {
            result: row,
            counted,
            is_undated,
        }
    }

    /// In a word, for tables.
    pub fn status(&self) -> &'static str {
        match &self.result.outcome {
            EntryOutcome::Graded(_) => "graded",
            EntryOutcome::NothingToGrade(_) => "nothing to grade",
            EntryOutcome::Fault(_) => "not graded",
        }
    }

    /// Why there is no score. Empty if there is one.
    pub fn why(&self) -> &str {
        match &self.result.outcome {
            EntryOutcome::Graded(_) => "",
            EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why) => why,
        }
    }
}
