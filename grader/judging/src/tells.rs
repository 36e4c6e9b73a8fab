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
pub struct Tells {
    /// Which elements, counted from 0 over all questions of the item.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elements: Vec<u32>,
    /// Their right answers.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "packed::text")]
    pub right: Vec<Seen>,
    /// The wrong ones, and whose they are. A mistake that is not among them answers rightly.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong: Vec<Told>,
}

impl Tells {
    /// Whether nothing is told.
    pub fn is_none(&self) -> bool {
        self.elements.is_empty()
    }
}

/// What some mistakes, all alike, answer to an item's elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Told {
    /// Their places in the exam's list of mistakes.
    pub by: Vec<u32>,
    /// For each element of the tells that they get wrong: its place among those, and the answer.
    #[serde(with = "packed::text")]
    pub answers: Vec<(u32, Seen)>,
}

/// As much of an answer's element as tells mistakes apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Seen {
    /// The numbers that are judged, in the order of the key's parts.
    Numbers(Vec<f32>),
    /// No hit, or no time inside a box.
    Nothing,
    /// What is wrong with a tree, if anything is, and by how much where that is a number.
    Tree(Option<(String, f32)>),
    /// The code panicked.
    Panicked,
    /// There was no answer to the whole item.
    NoAnswer(Silence),
}

/// Why there was no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Silence {
    /// It took too long.
    Time,
    /// It took too much memory.
    Memory,
    /// The stack overflowed.
    Stack,
    /// Something else took the process down, or what came was no answer.
    Other,
}

impl Seen {
    /// How far two numbers may be apart and still come from the same mistake: other formulas round
    /// differently. Relative; absolute below 1.
    const TOLERANCE: f32 = 1e-3;
    /// The same for what a tree costs: builders of the same mind make somewhat different trees.
    const COST_TOLERANCE: f32 = 0.08;

    /// Whether it says nothing of what went on: only that it came to no good end.
    pub fn is_mute(&self) -> bool {
        match self {
            Seen::Panicked | Seen::NoAnswer(_) => true,
            Seen::Numbers(_) | Seen::Nothing | Seen::Tree(_) => false,
        }
    }

    /// Whether both may come from the same mistake.
    pub fn is_like(&self, other: &Seen) -> bool {
        match (self, other) {
            (Seen::Numbers(a), Seen::Numbers(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(*a, *b, Seen::TOLERANCE))
            }
            (Seen::Tree(Some((what, a))), Seen::Tree(Some((other, b)))) => {
                what == other && alike(*a, *b, Seen::COST_TOLERANCE)
            }
            (Seen::Tree(a), Seen::Tree(b)) => a.is_none() && b.is_none(),
            (Seen::NoAnswer(a), Seen::NoAnswer(b)) => a == b,
            (Seen::Nothing, Seen::Nothing) | (Seen::Panicked, Seen::Panicked) => true,
            (
                Seen::Numbers(_)
                | Seen::Nothing
                | Seen::Tree(_)
                | Seen::Panicked
                | Seen::NoAnswer(_),
                _,
            ) => false,
        }
    }
}

fn alike(a: f32, b: f32, tolerance: f32) -> bool {
    let close = (a - b).abs() <= tolerance * a.abs().max(1.0);
    // Infinities of one sign are equal; what is not a number is like what is not one.
    a == b || (a.is_nan() && b.is_nan()) || (close && a.is_finite() && b.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_alike_up_to_rounding_and_infinities_and_nan_are_like_themselves() {
        let seen = |numbers: &[f32]| Seen::Numbers(numbers.to_vec());
        assert!(seen(&[2.0, f32::NAN]).is_like(&seen(&[2.001, f32::NAN])));
        assert!(seen(&[f32::INFINITY]).is_like(&seen(&[f32::INFINITY])));
        assert!(!seen(&[2.0]).is_like(&seen(&[2.01])));
        assert!(!seen(&[f32::INFINITY]).is_like(&seen(&[f32::NEG_INFINITY])));
        assert!(!seen(&[1.0]).is_like(&seen(&[1.0, 1.0])));
        assert!(!seen(&[0.0]).is_like(&Seen::Nothing));
    }

    #[test]
    fn trees_are_alike_in_what_is_wrong_with_them() {
        let costs = |ratio| Seen::Tree(Some(("SAH cost".to_owned(), ratio)));
        assert!(costs(1.5).is_like(&costs(1.55)));
        assert!(!costs(1.5).is_like(&costs(2.5)));
        assert!(!costs(1.5).is_like(&Seen::Tree(None)));
    }
}
