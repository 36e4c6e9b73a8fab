//! Signatures of known mistakes: the wrong answers that identify each mistake.

use protocol::packed;
use serde::{Deserialize, Serialize};

use crate::section::Section;

/// A known mistake and what the report says about it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownMistake {
    /// Id of the mistake, such as `sphere.far_first`.
    pub id: String,
    /// A question that helps students find the mistake.
    pub nudge: String,
    /// An explanation of the mistake.
    pub hint: String,
    /// The handout section to read, if it differs from the item's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
}

/// The answers that a task's known mistakes produce for some elements of one item.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MistakeSignatures {
    /// The indices of the elements, counted from 0 across all questions of the item.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elements: Vec<u32>,
    /// The correct answers to these elements.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "packed::text")]
    pub correct_answers: Vec<ObservedAnswer>,
    /// The wrong answers. A mistake that isn't listed answers all elements correctly.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mistake_answers: Vec<MistakeAnswers>,
}

impl MistakeSignatures {
    /// Returns whether the list of signatures is empty.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }
}

/// The answers to one item, shared by one or more mistakes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MistakeAnswers {
    /// Indices into the exam's list of mistakes.
    pub mistakes: Vec<u32>,
    /// The wrong answers, each with its index in [`MistakeSignatures::elements`].
    #[serde(with = "packed::text")]
    pub answers: Vec<(u32, ObservedAnswer)>,
}

/// The part of an answer that distinguishes mistakes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ObservedAnswer {
    /// The numbers that are checked, in the order of the key's checks, each as a multiple of its
    /// tolerance.
    Numbers(Vec<f32>),
    /// No hit, or no interval inside the box.
    NoHit,
    /// The name and the amount of a tree's defect. The amount may be 0. `None` for a correct tree.
    Tree(Option<(String, f32)>),
    /// The code panicked with an unclassified message.
    Panicked,
    /// The entire item is unanswered.
    NoAnswer(NoAnswerReason),
    // This variant is last, so that exams written before it existed can still be read.
    /// The code panicked with an error of this kind.
    PanickedBy(PanicKind),
}

/// The reason there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoAnswerReason {
    /// The time limit was exceeded.
    Time,
    /// The memory limit was exceeded.
    Memory,
    /// The stack overflowed.
    Stack,
    /// The process ended for another reason, or its output was invalid.
    Other,
}

/// The kind of error that a panic reports. Code with the same mistake may panic with different
/// messages and numbers, but the kind is the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PanicKind {
    /// An index or a range that is out of bounds.
    Index,
    /// An integer overflow, or an integer division by zero.
    Arithmetic,
    /// `unwrap` called on a missing value.
    NoValue,
}

impl PanicKind {
    /// Returns the kind of a panic with this message, if the message is one of the standard
    /// library's.
    pub fn of(message: &str) -> Option<Self> {
        let kinds = [
            ("index out of bounds", PanicKind::Index),
            ("range start index", PanicKind::Index),
            ("range end index", PanicKind::Index),
            ("slice index starts at", PanicKind::Index),
            ("mid > len", PanicKind::Index),
            ("attempt to", PanicKind::Arithmetic),
            ("called `Option::unwrap()`", PanicKind::NoValue),
            ("called `Result::unwrap()`", PanicKind::NoValue),
        ];
        let mut known = kinds.into_iter();
        let found = known.find(|(start, _)| message.starts_with(start));
        found.map(|(_, kind)| kind)
    }
}

impl ObservedAnswer {
    /// Maximum difference between the amounts, such as SAH costs, of two tree defects that may come
    /// from the same mistake. The limit is relative for amounts of at least 1, and absolute for
    /// smaller amounts. It is larger than the limit for other numbers because builders with the
    /// same mistake produce slightly different trees.
    const COST: f32 = 0.08;

    /// Returns the observation for a panic with this message.
    pub fn of_panic(message: &str) -> Self {
        PanicKind::of(message).map_or(ObservedAnswer::Panicked, ObservedAnswer::PanickedBy)
    }

    /// Returns whether the answer only says that the result is missing, without any information
    /// about the cause.
    pub fn is_uninformative(&self) -> bool {
        match self {
            ObservedAnswer::Panicked
            | ObservedAnswer::PanickedBy(_)
            | ObservedAnswer::NoAnswer(_) => true,
            ObservedAnswer::Numbers(_) | ObservedAnswer::NoHit | ObservedAnswer::Tree(_) => false,
        }
    }

    /// Returns whether the answer is a panic of a kind that few mistakes cause.
    pub fn is_unusual_panic(&self) -> bool {
        matches!(self, ObservedAnswer::PanickedBy(_))
    }

    /// Returns whether the answer may come from a submission with several mistakes, given the
    /// correct answer and the answers produced by the mistakes that change it. If several mistakes
    /// change a number, it can be anything.
    pub fn is_made_of(&self, correct: &ObservedAnswer, wrong: &[&ObservedAnswer]) -> bool {
        if let [] | [_] = wrong {
            return self.matches(wrong.first().unwrap_or(&correct));
        }
        let (Some(own), Some(correct)) = (self.numbers(), correct.numbers()) else {
            return true;
        };
        let all: Option<Vec<&[f32]>> = wrong.iter().map(|wrong| wrong.numbers()).collect();
        let all = all.filter(|all| {
            let mut lengths = all.iter().chain([&correct]).map(|numbers| numbers.len());
            lengths.all(|length| length == own.len())
        });
        let Some(all) = all else { return true };
        own.iter()
            .zip(correct)
            .enumerate()
            .all(|(index, (&own, &correct))| {
                let numbers = all.iter().map(|numbers| numbers[index]);
                let changed: Vec<f32> = numbers
                    .filter(|number| !same_number(*number, correct))
                    .collect();
                match changed[..] {
                    [] => same_number(own, correct),
                    [only] => same_number(own, only),
                    [_, _, ..] => true,
                }
            })
    }

    /// Returns whether the answer is a miss.
    pub fn is_miss(&self) -> bool {
        matches!(self, ObservedAnswer::NoHit)
    }

    fn numbers(&self) -> Option<&[f32]> {
        match self {
            ObservedAnswer::Numbers(numbers) => Some(numbers),
            ObservedAnswer::NoHit
            | ObservedAnswer::Tree(_)
            | ObservedAnswer::Panicked
            | ObservedAnswer::PanickedBy(_)
            | ObservedAnswer::NoAnswer(_) => None,
        }
    }

    /// Returns the name of the tree's defect.
    pub fn tree_defect(&self) -> Option<&str> {
        match self {
            ObservedAnswer::Tree(defect) => defect.as_ref().map(|(name, _)| name.as_str()),
            ObservedAnswer::Numbers(_)
            | ObservedAnswer::NoHit
            | ObservedAnswer::Panicked
            | ObservedAnswer::PanickedBy(_)
            | ObservedAnswer::NoAnswer(_) => None,
        }
    }

    /// Returns whether both answers may come from the same mistake.
    pub fn matches(&self, other: &ObservedAnswer) -> bool {
        match (self, other) {
            (ObservedAnswer::Numbers(a), ObservedAnswer::Numbers(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same_number(*a, *b))
            }
            (ObservedAnswer::Tree(Some((what, a))), ObservedAnswer::Tree(Some((other, b)))) => {
                what == other && nearly_equal(*a, *b, Self::COST, Self::COST)
            }
            (ObservedAnswer::Tree(a), ObservedAnswer::Tree(b)) => a.is_none() && b.is_none(),
            (ObservedAnswer::NoAnswer(a), ObservedAnswer::NoAnswer(b)) => a == b,
            (ObservedAnswer::PanickedBy(a), ObservedAnswer::PanickedBy(b)) => a == b,
            (ObservedAnswer::NoHit, ObservedAnswer::NoHit)
            | (ObservedAnswer::Panicked, ObservedAnswer::Panicked) => true,
            (
                ObservedAnswer::Numbers(_)
                | ObservedAnswer::NoHit
                | ObservedAnswer::Tree(_)
                | ObservedAnswer::Panicked
                | ObservedAnswer::PanickedBy(_)
                | ObservedAnswer::NoAnswer(_),
                _,
            ) => false,
        }
    }
}

/// Returns whether two numbers, as multiples of their tolerances, may come from the same mistake.
/// They need not be equal, because equivalent formulas round differently.
fn same_number(a: f32, b: f32) -> bool {
    const RELATIVE: f32 = 1e-3;
    const MULTIPLES: f32 = 2.0;
    nearly_equal(a, b, RELATIVE, MULTIPLES)
}

fn nearly_equal(a: f32, b: f32, relative: f32, absolute: f32) -> bool {
    let close = (a - b).abs() <= (relative * a.abs()).max(absolute);
    // Infinities of the same sign are equal, and NaN matches NaN.
    a == b || (a.is_nan() && b.is_nan()) || (close && a.is_finite() && b.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_match_up_to_rounding() {
        let numbers = |numbers: &[f32]| ObservedAnswer::Numbers(numbers.to_vec());
        assert!(numbers(&[2e4, f32::NAN]).matches(&numbers(&[2.001e4, f32::NAN])));
        assert!(numbers(&[-2e4]).matches(&numbers(&[-2.001e4])));
        assert!(numbers(&[0.0]).matches(&numbers(&[1.9])));
        assert!(numbers(&[f32::INFINITY]).matches(&numbers(&[f32::INFINITY])));
        assert!(!numbers(&[2e4]).matches(&numbers(&[2.01e4])));
        assert!(!numbers(&[0.0]).matches(&numbers(&[2.1])));
        assert!(!numbers(&[f32::INFINITY]).matches(&numbers(&[f32::NEG_INFINITY])));
        assert!(!numbers(&[f32::NAN]).matches(&numbers(&[1.0])));
        assert!(!numbers(&[1.0]).matches(&numbers(&[f32::NAN])));
        assert!(!numbers(&[1.0]).matches(&numbers(&[1.0, 1.0])));
        assert!(!numbers(&[0.0]).matches(&ObservedAnswer::NoHit));
    }

    #[test]
    fn trees_match_by_their_defect() {
        let costs = |ratio| ObservedAnswer::Tree(Some(("SAH cost".to_owned(), ratio)));
        assert!(costs(1.5).matches(&costs(1.55)));
        assert!(!costs(1.5).matches(&costs(2.5)));
        assert!(!costs(1.5).matches(&ObservedAnswer::Tree(None)));
        assert_eq!(costs(1.5).tree_defect(), Some("SAH cost"));
        assert_eq!(ObservedAnswer::Tree(None).tree_defect(), None);
    }

    #[test]
    fn missing_answers_match_if_they_are_missing_for_the_same_reason() {
        let panic = |message| ObservedAnswer::of_panic(message);
        let index = panic("index out of bounds: the len is 3 but the index is 7");
        assert_eq!(index, ObservedAnswer::PanickedBy(PanicKind::Index));
        let overflow = panic("attempt to subtract with overflow");
        assert_eq!(overflow, ObservedAnswer::PanickedBy(PanicKind::Arithmetic));
        assert_eq!(panic("not my day"), ObservedAnswer::Panicked);
        let stack = ObservedAnswer::NoAnswer(NoAnswerReason::Stack);
        let time = ObservedAnswer::NoAnswer(NoAnswerReason::Time);
        let reasons = [&index, &overflow, &stack, &time, &ObservedAnswer::Panicked];
        for (number, one) in reasons.iter().enumerate() {
            assert!(one.is_uninformative());
            for (other_number, other) in reasons.iter().enumerate() {
                assert_eq!(one.matches(other), number == other_number);
            }
        }
        assert!(index.is_unusual_panic());
        assert!(!ObservedAnswer::Panicked.is_unusual_panic());
        assert!(!ObservedAnswer::NoHit.is_uninformative());
        assert!(ObservedAnswer::NoHit.is_miss());
        assert!(!index.is_miss());
    }

    #[test]
    fn numbers_that_one_of_two_mistakes_changes_are_its_own() {
        let numbers =
            |numbers: [f32; 2]| ObservedAnswer::Numbers(numbers.map(|n| n * 100.0).into());
        let correct = numbers([1.0, 2.0]);
        let (one, other) = (numbers([7.0, 2.0]), numbers([1.0, 8.0]));
        let is_made = |own: [f32; 2]| numbers(own).is_made_of(&correct, &[&one, &other]);
        assert!(is_made([7.0, 8.0]));
        assert!(!is_made([7.0, 9.0]));
        assert!(!is_made([1.0, 8.0]));
        // Both change the first number, so it can be anything. Neither changes the second.
        let also = numbers([8.0, 2.0]);
        let of_both = |own: [f32; 2]| numbers(own).is_made_of(&correct, &[&one, &also]);
        assert!(of_both([9.0, 2.0]));
        assert!(!of_both([9.0, 3.0]));
        // A miss has no numbers to compare.
        assert!(numbers([5.0, 5.0]).is_made_of(&correct, &[&one, &ObservedAnswer::NoHit]));
        assert!(one.is_made_of(&correct, &[&one]));
        assert!(!other.is_made_of(&correct, &[&one]));
        assert!(correct.is_made_of(&correct, &[]));
    }

    #[test]
    fn numbers_of_other_quantities_are_not_compared() {
        let numbers = |count: usize| ObservedAnswer::Numbers(vec![0.0; count]);
        let (one, two, three) = (numbers(1), numbers(2), numbers(3));
        assert!(two.is_made_of(&two, &[&two, &one]));
        assert!(two.is_made_of(&three, &[&two, &two]));
        assert!(three.is_made_of(&two, &[&two, &two]));
    }

    #[test]
    fn an_item_without_elements_has_no_signatures() {
        assert!(MistakeSignatures::default().is_empty());
        let one = MistakeSignatures {
            elements: vec![0],
            ..MistakeSignatures::default()
        };
        assert!(!one.is_empty());
    }
}
