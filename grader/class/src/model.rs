//! The data of a graded class, from which all files of the class are written.

use grader::policy::{CountedPoints, Policy};

use crate::entry::Person;
use crate::late::{apply_policy, is_undated};
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary};

/// The results of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GradedClass {
    /// The exam's name.
    pub exam: String,
    /// The hash of the exam file.
    pub exam_hash: String,
    /// The isolation level at which the submissions were graded.
    pub isolation: String,
    /// The submissions, in the order of their ids.
    pub rows: Vec<ClassRow>,
    /// The people on the rosters who submitted nothing.
    pub missing: Vec<Person>,
}

/// A submission's result and its final points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassRow {
    /// The result of grading the submission.
    pub result: EntryResult,
    /// The final points, after the policy has been applied; `None` if there is no score, or if the
    /// submission time is unclear.
    pub counted: Option<CountedPoints>,
    /// The reason why a score has no final points: a submission time that cannot be read.
    pub unclear_time: Option<String>,
    /// Whether the submission counts as on time because its submission time is unknown.
    pub is_undated: bool,
}

impl GradedClass {
    /// Returns the results that have a score.
    pub fn scores(&self) -> impl Iterator<Item = (&EntryResult, &ScoreSummary)> {
        let results = self.rows.iter().map(|row| &row.result);
        results.filter_map(|result| Some((result, result.score()?)))
    }

    /// Returns the number of submissions that could not be graded because of a fault, and have to
    /// be graded again.
    pub fn fault_count(&self) -> usize {
        let is_fault = |row: &&ClassRow| matches!(row.result.outcome, EntryOutcome::Fault(_));
        self.rows.iter().filter(is_fault).count()
    }
}

impl ClassRow {
    /// Creates the row of a result, and applies the policy to its points.
    pub fn new(result: EntryResult, policy: &Policy) -> Self {
        let score = result.score();
        let counted = score.map(|score| apply_policy(policy, &result.info, score));
        let (counted, unclear_time) = match counted.transpose() {
            Ok(counted) => (counted, None),
            Err(unclear) => (None, Some(unclear.to_string())),
        };
        let is_undated = counted.is_some() && is_undated(policy, &result.info);
        ClassRow {
            result,
            counted,
            unclear_time,
            is_undated,
        }
    }

    /// Returns a sentence about what the score counts towards the grade, or `None` if it counts as
    /// it is.
    pub fn counted_text(&self) -> Option<String> {
        if let Some(why) = &self.unclear_time {
            return Some(format!("No points count yet: {why}."));
        }
        let (counted, score) = (self.counted?, self.result.score()?);
        let CountedPoints {
            points,
            max_points,
            late_days,
            is_closed,
        } = counted;
        let when = match late_days {
            0 => "handed in on time",
            1 => "handed in 1 day late",
            _ => &format!("handed in {late_days} days late"),
        };
        let end = if is_closed {
            ", after the last day"
        } else {
            ""
        };
        let is_unchanged = (points, max_points) == (score.points, score.max_points);
        (!is_unchanged || late_days > 0).then(|| {
            format!("{points} of {max_points} points count towards the grade: {when}{end}.")
        })
    }

    /// Returns the status, as it is shown in tables.
    pub fn status(&self) -> &'static str {
        match &self.result.outcome {
            EntryOutcome::Graded(_) if self.unclear_time.is_some() => "time unclear",
            EntryOutcome::Graded(_) => "graded",
            EntryOutcome::NothingToGrade(_) => "nothing to grade",
            EntryOutcome::Fault(_) => "not graded",
        }
    }

    /// Returns the reason why there is no score or no final points, or an empty string if there are
    /// both.
    pub fn why(&self) -> &str {
        match &self.result.outcome {
            EntryOutcome::Graded(_) => self.unclear_time.as_deref().unwrap_or_default(),
            EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why) => why,
        }
    }
}
