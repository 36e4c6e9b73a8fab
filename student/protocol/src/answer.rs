//! Answers that the probe sends to the grader.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::function::{Color, Density, Fraction, LocalDirection, Output, ResultText, Scattered};
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
    /// The answer of a function that always returns a direction.
    Directions(Vec<ElementOutcome<LocalDirection>>),
    /// The answer of a function that may return no direction.
    OptionalDirections(Vec<ElementOutcome<Option<LocalDirection>>>),
    /// The answer of a function that samples how a material continues a path.
    Scattered(Vec<ElementOutcome<Scattered>>),
    /// The answer of a function that returns a value for each colour channel.
    Colors(Vec<ElementOutcome<Color>>),
    /// The answer of a function that returns a probability density.
    Densities(Vec<ElementOutcome<Density>>),
    /// The answer of a function that returns a fraction of the light.
    Fractions(Vec<ElementOutcome<Fraction>>),
    /// The answer to `Build`: the tree.
    Tree(ElementOutcome<Tree>),
    /// The answer to `Radiance`: the pixels in linear red, green and blue, row by row from the
    /// bottom.
    Picture(ElementOutcome<Vec<Vec3>>),
}

/// The outcome of one row: the record that the function returned, or `None`.
pub type RowOutcome<'a> = ElementOutcome<Option<&'a dyn Record>>;

/// The answer to a table for any function, with one outcome per row.
pub trait AnyRows {
    /// Returns the outcome of each row.
    fn outcomes(&self) -> Vec<RowOutcome<'_>>;

    /// Returns the names of the fields in each row.
    fn names(&self) -> &'static [&'static str];

    /// Returns the templates for printing rows.
    fn result_text(&self) -> ResultText;

    /// Returns the answer for one row, or `None` if it is missing.
    fn single(&self, row: usize) -> Option<Answer>;
}

impl<T: Output> AnyRows for Vec<ElementOutcome<T>> {
    fn outcomes(&self) -> Vec<RowOutcome<'_>> {
        let record = |value| Output::record(value).map(|record| record as &dyn Record);
        self.iter().map(|row| row.map(record)).collect()
    }

    fn names(&self) -> &'static [&'static str] {
        T::NAMES
    }

    fn result_text(&self) -> ResultText {
        T::RESULT_TEXT
    }

    fn single(&self, row: usize) -> Option<Answer> {
        Some(T::answer(vec![self.get(row)?.clone()]))
    }
}

impl Answer {
    /// Returns the rows, if this is the answer to a table.
    pub fn table(&self) -> Option<&dyn AnyRows> {
        match self {
            Answer::Rays(rows) => Some(rows),
            Answer::Hits(rows) => Some(rows),
            Answer::Spans(rows) => Some(rows),
            Answer::Directions(rows) => Some(rows),
            Answer::OptionalDirections(rows) => Some(rows),
            Answer::Scattered(rows) => Some(rows),
            Answer::Colors(rows) => Some(rows),
            Answer::Densities(rows) => Some(rows),
            Answer::Fractions(rows) => Some(rows),
            Answer::Tree(_) | Answer::Picture(_) => None,
        }
    }

    /// Returns the outcome of each row, if this is the answer to a table.
    pub fn rows(&self) -> Option<Vec<RowOutcome<'_>>> {
        self.table().map(AnyRows::outcomes)
    }

    /// Returns the names of the fields in each row, if this is the answer to a table.
    pub fn names(&self) -> Option<&'static [&'static str]> {
        self.table().map(AnyRows::names)
    }

    /// Returns the templates for printing rows, if this is the answer to a table.
    pub fn result_text(&self) -> Option<ResultText> {
        self.table().map(AnyRows::result_text)
    }

    /// Returns whether a row of a table, or the tree, is missing because of a `todo!`.
    pub fn is_unwritten(&self) -> bool {
        if let Answer::Tree(outcome) = self {
            return outcome.is_unwritten();
        }
        let mut rows = self.rows().into_iter().flatten();
        rows.any(|row| row.is_unwritten())
    }

    /// Returns the answer for one row of a table, or `None` if it is missing. Any other answer is
    /// returned unchanged.
    pub fn single(&self, row: usize) -> Option<Answer> {
        match self.table() {
            Some(rows) => rows.single(row),
            None => Some(self.clone()),
        }
    }
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

    /// Returns whether the code has yet to be written.
    pub fn is_unwritten(&self) -> bool {
        match self {
            ElementOutcome::Panicked(panic) => panic.is_unimplemented(),
            ElementOutcome::Value(_) | ElementOutcome::Skipped => false,
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
