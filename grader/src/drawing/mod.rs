//! Drawings of failed questions, to scale: what was asked, what came, what should have come.
//!
//! Pure, and without a way of its own to any answer: how a ray meets a shape, and how a tree is
//! built or walked, comes with the exam ([`crate::shown`]). Answers may hold any numbers.

mod canvas;
mod ink;
mod sheet;
mod window;

use protocol::Answer;

use crate::exam::Asked;

/// A drawing of one element of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// One `<svg>` element, to be put into a page as it is. It looks well from 340 pixels of width
    /// up, takes its colours from `color` and the custom properties `--right`, `--wrong` and
    /// `--paper` (the background), and has no ids.
    pub svg: String,
    /// What it shows, in a sentence.
    pub caption: String,
}

/// Draws one element of a question, counted from 0, beside the whole answer to the question, if one
/// came. None where there is nothing to see that words do not say.
pub fn of(asked: &Asked, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let _ = (asked, element, answer);
    None
}
