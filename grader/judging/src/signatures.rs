//! What known mistakes would answer: so that a wrong answer can be told from which mistake it comes.

use protocol::packed;
use serde::{Deserialize, Serialize};

use crate::section::Section;

/// A known mistake, in the words of a report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownMistake {
    /// Such as `sphere.far_first`.
    pub id: String,
    /// A question that leads there.
    pub nudge: String,
    /// What is wrong.
    pub hint: String,
    /// What teaches it, where that is not what teaches the item.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
}

/// What is told of one item: what each known mistake of its task answers to some of its elements.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MistakeSignatures {
    /// Which elements, counted from 0 over all questions of the item.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elements: Vec<u32>,
    /// Their right answers.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "packed::text")]
    #[serde(alias = "right")]
    pub correct_answers: Vec<ObservedAnswer>,
    /// The wrong ones, and whose they are. A mistake that is not among them answers rightly.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[serde(alias = "wrong")]
    pub mistake_answers: Vec<MistakeAnswers>,
}

impl MistakeSignatures {
    /// Whether nothing is told.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }
}

/// What some mistakes, all alike, answer to an item's elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MistakeAnswers {
    /// Their places in the exam's list of mistakes.
    #[serde(alias = "by")]
    pub mistakes: Vec<u32>,
    /// For each element of the tells that they get wrong: its place among those, and the answer.
    #[serde(with = "packed::text")]
    pub answers: Vec<(u32, ObservedAnswer)>,
}

/// As much of an answer's element as tells mistakes apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ObservedAnswer {
    /// The numbers that are judged, in the order of the key's parts.
    Numbers(Vec<f32>),
    /// No hit, or no time inside a box.
    #[serde(alias = "Nothing")]
    NoHit,
    /// What is wrong with a tree, if anything is, and by how much where that is a number.
    Tree(Option<(String, f32)>),
    /// The code panicked.
    Panicked,
    /// There was no answer to the whole item.
    NoAnswer(NoAnswerReason),
}

/// Why there was no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoAnswerReason {
    /// It took too long.
    Time,
    /// It took too much memory.
    Memory,
    /// The stack overflowed.
    Stack,
    /// Something else took the process down, or what came was no answer.
    Other,
}

impl ObservedAnswer {
    /// How far two numbers may be apart and still come from the same mistake: other formulas round
    /// differently. Relative; absolute below 1.
    const TOLERANCE: f32 = 1e-3;
    /// The same for what a tree costs: builders of the same mind make somewhat different trees.
    const COST_TOLERANCE: f32 = 0.08;

    /// Whether it says nothing of what went on: only that it came to no good end.
    pub fn is_uninformative(&self) -> bool {
        match self {
            ObservedAnswer::Panicked | ObservedAnswer::NoAnswer(_) => true,
            ObservedAnswer::Numbers(_) | ObservedAnswer::NoHit | ObservedAnswer::Tree(_) => false,
        }
    }

    /// Whether both may come from the same mistake.
    pub fn matches(&self, other: &ObservedAnswer) -> bool {
        match (self, other) {
            (ObservedAnswer::Numbers(a), ObservedAnswer::Numbers(b)) => {
                a.len() == b.len()
                    && a.iter()
                        .zip(b)
                        .all(|(a, b)| nearly_equal(*a, *b, ObservedAnswer::TOLERANCE))
            }
            (ObservedAnswer::Tree(Some((what, a))), ObservedAnswer::Tree(Some((other, b)))) => {
                what == other && nearly_equal(*a, *b, ObservedAnswer::COST_TOLERANCE)
            }
            (ObservedAnswer::Tree(a), ObservedAnswer::Tree(b)) => a.is_none() && b.is_none(),
            (ObservedAnswer::NoAnswer(a), ObservedAnswer::NoAnswer(b)) => a == b,
            (ObservedAnswer::NoHit, ObservedAnswer::NoHit)
            | (ObservedAnswer::Panicked, ObservedAnswer::Panicked) => true,
            (
                ObservedAnswer::Numbers(_)
                | ObservedAnswer::NoHit
                | ObservedAnswer::Tree(_)
                | ObservedAnswer::Panicked
                | ObservedAnswer::NoAnswer(_),
                _,
            ) => false,
        }
    }
}

fn nearly_equal(a: f32, b: f32, tolerance: f32) -> bool {
    let close = (a - b).abs() <= tolerance * a.abs().max(1.0);
    // Infinities of one sign are equal; what is not a number is like what is not one.
    a == b || (a.is_nan() && b.is_nan()) || (close && a.is_finite() && b.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_match_up_to_rounding() {
        let seen = |numbers: &[f32]| ObservedAnswer::Numbers(numbers.to_vec());
        assert!(seen(&[2.0, f32::NAN]).matches(&seen(&[2.001, f32::NAN])));
        assert!(seen(&[f32::INFINITY]).matches(&seen(&[f32::INFINITY])));
        assert!(!seen(&[2.0]).matches(&seen(&[2.01])));
        assert!(!seen(&[f32::INFINITY]).matches(&seen(&[f32::NEG_INFINITY])));
        assert!(!seen(&[1.0]).matches(&seen(&[1.0, 1.0])));
        assert!(!seen(&[0.0]).matches(&ObservedAnswer::NoHit));
    }

    #[test]
    fn trees_match_by_their_defect() {
        let costs = |ratio| ObservedAnswer::Tree(Some(("SAH cost".to_owned(), ratio)));
        assert!(costs(1.5).matches(&costs(1.55)));
        assert!(!costs(1.5).matches(&costs(2.5)));
        assert!(!costs(1.5).matches(&ObservedAnswer::Tree(None)));
    }
}
