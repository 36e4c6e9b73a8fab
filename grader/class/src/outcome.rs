//! What became of each entry, as it is kept and as it is told.

use serde::de::Error;
use serde::{Deserialize, Serialize};

use crate::entry::About;

/// One line of the class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The entry's id.
    pub id: String,
    /// Whose it is.
    pub about: About,
    /// What became of it.
    pub outcome: Outcome,
}

/// What became of an entry. Only the first is a score.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was graded.
    Graded(Box<Told>),
    /// There was nothing that could be graded: the student's matter, and for a person to decide.
    NoSubmission(String),
    /// It was not graded, and the fault is ours or the machine's: for another try.
    Fault(String),
}

/// What the class's files need of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Told {
    /// Of all tasks.
    pub points: u32,
    /// The most that could be had.
    pub max_points: u32,
    /// In lecture order.
    pub tasks: Vec<Task>,
}

/// One task of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Task {
    /// Such as `sphere`.
    pub id: String,
    /// What people read.
    pub title: String,
    /// Of its items.
    pub points: u32,
    /// The most that could be had.
    pub max_points: u32,
    /// In the order of asking.
    pub items: Vec<Item>,
}

/// One item of a score file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Item {
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
    pub about: About,
    /// What became of it.
    #[serde(flatten)]
    pub state: State,
}

/// An outcome without its score, which has a file of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "state", content = "why", rename_all = "snake_case")]
pub enum State {
    /// There is a score.
    Graded,
    /// There was nothing that could be graded.
    NoSubmission(String),
    /// Our fault, or the machine's.
    Fault(String),
}

impl Told {
    /// Reads a score file. It may come from another machine: points that no exam has are no points.
    pub fn read(text: &str) -> Result<Self, serde_json::Error> {
        /// More than any exam has, and few enough that a class's sum is a number.
        const MOST: u32 = 100_000;
        let told: Told = serde_json::from_str(text)?;
        match told.all_points().max() {
            Some(points) if points > MOST => {
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
    pub fn items(&self) -> impl Iterator<Item = &Item> {
        self.tasks.iter().flat_map(|task| &task.items)
    }
}

impl Row {
    /// The score, if there is one.
    pub fn score(&self) -> Option<&Told> {
        match &self.outcome {
            Outcome::Graded(score) => Some(score),
            Outcome::NoSubmission(_) | Outcome::Fault(_) => None,
        }
    }
}
