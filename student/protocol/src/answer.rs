//! What a submission's probe answers.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::interval::Interval;
use crate::ray::Ray;
use crate::trace::Trace;
use crate::tree::Tree;

/// The answer to the [`Question`](crate::Question) of the same kind, element by element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// To `Camera`: a ray for each sample.
    Rays(Vec<ElementOutcome<Ray>>),
    /// To `Shapes`, `Traverse` and `BuildAndTraverse`: the closest hit of each ray.
    Hits(Vec<ElementOutcome<Option<Trace>>>),
    /// To `BBox`: the part of each shot's times that lies in the box.
    Spans(Vec<ElementOutcome<Option<Interval>>>),
    /// To `Build`.
    Tree(ElementOutcome<Tree>),
    /// To `Radiance`: linear red, green and blue, row by row from the bottom.
    Picture(ElementOutcome<Vec<Vec3>>),
    /// To `Done`.
    Done,
}

/// What became of one element of a question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ElementOutcome<T> {
    /// The submission's value.
    Value(T),
    /// The submission's code panicked.
    Panicked(Panic),
    /// Not asked any more, after [`Panic::PATIENCE`] panics in the same question.
    #[serde(alias = "GivenUp")]
    Skipped,
}

/// A panic, as much of it as is worth telling.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Panic {
    /// The panic's own words, cut at [`Panic::LONGEST`] bytes.
    pub message: String,
    /// The file and line, such as `sphere.rs:34`.
    #[serde(alias = "place")]
    pub location: String,
}

impl Panic {
    /// The most bytes of a message or place that are kept.
    pub const MAX_TEXT_BYTES: usize = 600;
    /// After so many panics in one question, its other elements are not asked.
    pub const MAX_PER_QUESTION: usize = 3;

    /// Whether the panic is `todo!` or `unimplemented!`: the task is not written yet.
    pub fn is_unimplemented(&self) -> bool {
        self.message.starts_with("not yet implemented")
            || self.message.starts_with("not implemented")
    }
}
