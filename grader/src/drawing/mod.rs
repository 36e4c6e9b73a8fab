//! A drawing of one question, its answer and what is right.

use protocol::Answer;

use crate::exam::Asked;

/// A drawing for a page.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// One `<svg>` element, with a title and a description.
    pub svg: String,
    /// What is to be seen.
    pub caption: String,
}

/// The drawing of one element of a question, where there is one.
pub fn of(_asked: &Asked, _element: usize, _answer: Option<&Answer>) -> Option<Drawing> {
    None
}
