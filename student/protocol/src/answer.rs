//! Answers that the probe sends to the grader.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::interval::Interval;
use crate::ray::Ray;
use crate::trace::Trace;
use crate::tree::Tree;

/// The answer to one [`Question`](crate::Question), with one outcome per element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// The answer to `Camera`: a ray for each sample.
    Rays(Vec<ElementOutcome<Ray>>),
    /// The answer to `Shapes`, `Traverse` or `BuildAndTraverse`: the closest hit of each ray.
    Hits(Vec<ElementOutcome<Option<Trace>>>),
    /// The answer to `BBox`: for each query, the part of its `times` interval in which the ray is
    /// inside the box, or `None` if it is never inside.
    Spans(Vec<ElementOutcome<Option<Interval>>>),
    /// The answer to `Build`: the tree.
    Tree(ElementOutcome<Tree>),
    /// The answer to `Radiance`: the pixels in linear red, green and blue, row by row from the
    /// bottom.
    Picture(ElementOutcome<Vec<Vec3>>),
    /// The answer to `Done`.
    Done,
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
    /// is not written yet.
    pub fn is_unimplemented(&self) -> bool {
        self.message.starts_with("not yet implemented")
            || self.message.starts_with("not implemented")
    }
}
