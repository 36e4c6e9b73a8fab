//! What became of each entry, as it is kept and as it is told.

use serde::de::Error;
use serde::{Deserialize, Serialize};

use crate::entry::EntryInfo;

/// One line of the class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryResult {
    /// The entry's id.
    pub id: String,
    /// Whose it is.
    pub info: EntryInfo,
    /// What became of it.
    pub outcome: EntryOutcome,
}

/// What became of an entry. Only the first is a score.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EntryOutcome {
    /// It was graded.
    Graded(Box<ScoreSummary>),
    /// There was nothing that could be graded: the student's matter, and for a person to decide.
    NothingToGrade(String),
    /// It was not graded, and the fault is ours or the machine's: for another try.
    Fault(String),
}

/// What the class's files need of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct ScoreSummary {
    /// Of all tasks.
    pub points: u32,
    /// The most that could be had.
    pub max_points: u32,
    /// In lecture order.
    pub tasks: Vec<TaskScore>,
}

/// One task of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct TaskScore {
    /// Such as `sphere`.
    pub id: String,
    /// What people read.
    pub title: String,
    /// Of its items.
    pub points: u32,
    /// The most that could be had.
    pub max_points: u32,
    /// In the order of asking.
    pub items: Vec<ItemScore>,
}

/// One item of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct ItemScore {
    /// Such as `sphere.from_inside`.
    pub id: String,
    /// What must hold.
    pub title: String,
    /// What it earned.
    pub points: u32,
    /// What it is worth.
    pub max_points: u32,
    /// What became of it.
    pub verdict: String,
    /// What happened, in a sentence.
    pub message: String,
    /// The known mistakes that answer the same.
    pub hints: Vec<Hint>,
}

/// A known mistake.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Hint {
    /// What is wrong.
    pub hint: String,
}

/// What is kept beside a score: that it is complete, what it follows from, and whose it is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp {
    /// Of the submission, and of all that its score follows from. Empty if there is no score.
    pub key: String,
    /// Whose it is.
    #[serde(rename = "about")]
    pub info: EntryInfo,
    /// What became of it.
    #[serde(flatten)]
    pub state: EntryState,
}

/// An outcome without its score, which has a file of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "state", content = "why", rename_all = "snake_case")]
pub enum EntryState {
    /// There is a score.
    Graded,
    /// There was nothing that could be graded.
    #[serde(rename = "no_submission")]
    NothingToGrade(String),
    /// Our fault, or the machine's.
    Fault(String),
}

impl ScoreSummary {
    /// Reads a score file. It may come from another machine: points that no exam has are no points.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        /// More than any exam has, and few enough that a class's sum is a number.
        const MAX_POINTS: u32 = 100_000;
        let told: ScoreSummary = serde_json::from_str(text)?;
        match told.all_points().max() {
            Some(points) if points > MAX_POINTS => {
                Err(serde_json::Error::custom(format!("{points} are no points")))
            }
            Some(_) | None => Ok(told),
        }
    }

    fn all_points(&self) -> impl Iterator<Item = u32> {
        let tasks = self.tasks.iter();
        let tasks = tasks.flat_map(|task| [task.points, task.max_points]);
        let items = self.items().flat_map(|item| [item.points, item.max_points]);
        tasks.chain(items).chain([self.points, self.max_points])
    }

    /// All items.
    pub fn items(&self) -> impl Iterator<Item = &ItemScore> {
        self.tasks.iter().flat_map(|task| &task.items)
    }
}

impl EntryResult {
    /// The score, if there is one.
    pub fn score(&self) -> Option<&ScoreSummary> {
        match &self.outcome {
            EntryOutcome::Graded(score) => Some(score),
            EntryOutcome::NothingToGrade(_) | EntryOutcome::Fault(_) => None,
        }
    }
}
