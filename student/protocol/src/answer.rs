//! Answers that the probe sends to the grader.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::function::{LocalDirection, Output, ResultText};
use crate::interval::Interval;
use crate::ray::{Ray, Trace};
use crate::tree::Tree;
use crate::value::Record;

/// The answer to one [`Question`](crate::Question), with one outcome per element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// The answer to `SampleRay`: a ray for each sample.
    Rays(Vec<ElementOutcome<Ray>>),
    /// The answer to `Hit`: the closest hit of each ray.
    Hits(Vec<ElementOutcome<Option<Trace>>>),
    /// The answer to `BBoxHit`: for each query, the part of its `times` interval that the ray
    /// spends inside the box, or `None` if it is never inside.
    Spans(Vec<ElementOutcome<Option<Interval>>>),
    /// The answer to `Reflect`: a reflected direction for each direction.
    Directions(Vec<ElementOutcome<LocalDirection>>),
    /// The answer to `Build`: the tree.
    Tree(ElementOutcome<Tree>),
    /// The answer to `Radiance`: the pixels in linear red, green and blue, row by row from the
    /// bottom.
    Picture(ElementOutcome<Vec<Vec3>>),
}

/// The outcome of one row: the record that the function returned, or `None`.
pub type RowOutcome<'a> = ElementOutcome<Option<&'a dyn Record>>;

impl Answer {
    /// Returns the rows, if this is the answer to a table.
    pub fn rows(&self) -> Option<Vec<RowOutcome<'_>>> {
        match self {
            Answer::Rays(rows) => Some(returned(rows)),
            Answer::Hits(rows) => Some(returned(rows)),
            Answer::Spans(rows) => Some(returned(rows)),
            Answer::Directions(rows) => Some(returned(rows)),
            Answer::Tree(_) | Answer::Picture(_) => None,
        }
    }

    /// Returns the names of the fields in each row, if this is the answer to a table.
    pub fn names(&self) -> Option<&'static [&'static str]> {
        match self {
            Answer::Rays(_) => Some(<Ray as Output>::NAMES),
            Answer::Hits(_) => Some(<Option<Trace> as Output>::NAMES),
            Answer::Spans(_) => Some(<Option<Interval> as Output>::NAMES),
            Answer::Directions(_) => Some(<LocalDirection as Output>::NAMES),
            Answer::Tree(_) | Answer::Picture(_) => None,
        }
    }

    /// Returns the templates for printing rows, if this is the answer to a table.
    pub fn result_text(&self) -> Option<ResultText> {
        match self {
            Answer::Rays(_) => Some(<Ray as Output>::RESULT_TEXT),
            Answer::Hits(_) => Some(<Option<Trace> as Output>::RESULT_TEXT),
            Answer::Spans(_) => Some(<Option<Interval> as Output>::RESULT_TEXT),
            Answer::Directions(_) => Some(<LocalDirection as Output>::RESULT_TEXT),
            Answer::Tree(_) | Answer::Picture(_) => None,
        }
    }

    /// Returns the answer for one row of a table, or `None` if it is missing. Any other answer is
    /// returned unchanged.
    pub fn single(&self, row: usize) -> Option<Answer> {
        Some(match self {
            Answer::Rays(rows) => Answer::Rays(vec![rows.get(row)?.clone()]),
            Answer::Hits(rows) => Answer::Hits(vec![rows.get(row)?.clone()]),
            Answer::Spans(rows) => Answer::Spans(vec![rows.get(row)?.clone()]),
            Answer::Directions(rows) => Answer::Directions(vec![rows.get(row)?.clone()]),
            Answer::Tree(_) | Answer::Picture(_) => self.clone(),
        })
    }
}

fn returned<T: Output>(rows: &[ElementOutcome<T>]) -> Vec<RowOutcome<'_>> {
    rows.iter().map(|row| row.map(Output::record)).collect()
}

/// The outcome of one element of a question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ElementOutcome<T> {
    /// The value that the submission returned.
    Value(T),
    /// The submission's code panicked.
    Panicked(Panic),
    /// The element was not run, because [`Panic::MAX_PER_QUESTION`] earlier elements panicked.
    Skipped,
}

impl<T> ElementOutcome<T> {
    /// Returns the value, if any.
    pub fn value(&self) -> Option<&T> {
        match self {
            ElementOutcome::Value(value) => Some(value),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
        }
    }

    /// Returns the same outcome after applying `change` to its value, if any.
    pub fn map<'a, U>(&'a self, change: impl FnOnce(&'a T) -> U) -> ElementOutcome<U> {
        match self {
            ElementOutcome::Value(value) => ElementOutcome::Value(change(value)),
            ElementOutcome::Panicked(panic) => ElementOutcome::Panicked(panic.clone()),
            ElementOutcome::Skipped => ElementOutcome::Skipped,
        }
    }
}

impl<T> From<Result<T, Panic>> for ElementOutcome<T> {
    fn from(result: Result<T, Panic>) -> Self {
        result.map_or_else(ElementOutcome::Panicked, ElementOutcome::Value)
    }
}

/// The message and location of a panic, as sent to the grader.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Panic {
    /// The panic message, truncated to [`Panic::MAX_TEXT_BYTES`].
    pub message: String,
    /// The file, line and column of the panic, such as `sphere.rs:34:9`, truncated to the same
    /// length.
    pub location: String,
}

impl Panic {
    /// The maximum length of `message` and of `location`, in bytes.
    pub const MAX_TEXT_BYTES: usize = 600;
    /// The number of panics in one question after which its remaining elements are skipped.
    pub const MAX_PER_QUESTION: usize = 3;

    /// Returns whether the panic came from `todo!` or `unimplemented!`, which means that the task
    /// isn't written yet.
    pub fn is_unimplemented(&self) -> bool {
        self.message.starts_with("not yet implemented")
            || self.message.starts_with("not implemented")
    }
}
