//! Compares answers with keys. This module is pure, and no other module awards credit.

mod credit;
mod deviation;
mod element_error;
mod first_hits;
mod mismatch;
pub(crate) mod quantity;
mod radiance;
mod scale;
mod spread;
pub(crate) mod table;
mod threshold;
pub mod tree;

use protocol::{Answer, Panic, Question};

use crate::exam::{ExamQuestion, Key};
use crate::symptom::Side;

use first_hits::FirstHits;
use mismatch::Position;
use radiance::Radiance;
use spread::Spread;
use table::TableAnswer;
use tree::{TreeAnswer, TreeCriteria};

pub use crate::types::Tolerance;
pub use credit::Credit;
pub use deviation::{Deviation, Measurement};
pub use element_error::element_error;
pub use mismatch::{Aspect, Mismatch};
pub use spread::cell_counts;
pub use threshold::Threshold;

/// The result for one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The fraction of the item's points that the answer earns.
    pub credit: Credit,
    /// The first error, if any.
    pub failure: Option<Failure>,
}

/// The first wrong element of a question.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Index of the element in the question.
    pub element: usize,
    /// The kind of error.
    pub kind: FailureKind,
    /// The number of wrong elements and the total, if they were counted.
    pub count: Option<(usize, usize)>,
}

/// The kind of error in an element.
#[derive(Clone, Debug, PartialEq)]
pub enum FailureKind {
    /// The answer is wrong.
    Wrong {
        /// The wrong quantity, such as `distance` or `normal`.
        what: String,
        /// Whether it is too small or too large, if that can be determined.
        side: Option<Side>,
        /// The submission's value.
        got: String,
        /// The expected value.
        wanted: String,
    },
    /// The answers are wrong together: they are unevenly spread. The element means nothing.
    Uneven {
        /// How uneven the answers are.
        got: String,
        /// How uneven they may be.
        wanted: String,
    },
    /// The submission's code panicked.
    Panicked(Panic),
    /// The answer is well formed, but doesn't belong to this question.
    Protocol(String),
}

impl Judgement {
    const RIGHT: Judgement = Judgement {
        credit: Credit::FULL,
        failure: None,
    };

    fn wrong(failure: Failure) -> Self {
        Judgement {
            credit: Credit::NONE,
            failure: Some(failure),
        }
    }

    fn protocol(why: &str) -> Self {
        Judgement::wrong(Failure {
            element: 0,
            kind: FailureKind::Protocol(why.to_owned()),
            count: None,
        })
    }
}

/// An answer and its key.
trait Comparison {
    /// Returns the answer's credit and its first error.
    fn judge(&self) -> Judgement;

    /// Returns the deviations found by all checks on the answer. All deviations are within their
    /// tolerances if and only if [`judge`](Comparison::judge) gives full credit.
    fn measure(&self) -> Vec<Measurement>;

    /// Returns the deviation of each quantity at each position of a picture. Returns `None` if the
    /// question doesn't ask for a picture.
    fn positions(&self) -> Option<Vec<Position>> {
        None
    }
}

/// Judges the answer to one question.
pub fn judge(question: &ExamQuestion, answer: &Answer) -> Judgement {
    match comparison(question, answer) {
        Some(comparison) => comparison.judge(),
        None => Judgement::protocol("an answer of the wrong kind"),
    }
}

/// Returns whether the first row's correct answer is correct for every other row too.
pub fn one_row_answers_all(asked: &ExamQuestion) -> bool {
    let Some(answer) = asked.single(0).key.answer() else {
        return false;
    };
    let mut others = (1..asked.question.count()).map(|row| asked.single(row));
    others.all(|other| judge(&other, &answer).credit == Credit::FULL)
}

/// Returns the deviations of the answer to one question. [`judge`] uses the same numbers.
pub fn measure(question: &ExamQuestion, answer: &Answer) -> Vec<Measurement> {
    match comparison(question, answer) {
        Some(comparison) => comparison.measure(),
        None => deviation::worst_by_threshold([Deviation::WRONG]),
    }
}

/// Returns the error at each position of a picture, in the order of the question's elements.
/// [`judge`] uses the same numbers. Returns `None` if the question doesn't ask for a picture, or if
/// the answer is the wrong size.
pub fn mismatches(question: &ExamQuestion, answer: &Answer) -> Option<Vec<Option<Mismatch>>> {
    let positions = comparison(question, answer)?.positions()?;
    Some(positions.iter().map(Mismatch::first_at).collect())
}

fn comparison<'a>(
    question: &'a ExamQuestion,
    answer: &'a Answer,
) -> Option<Box<dyn Comparison + 'a>> {
    Some(match (&question.key, answer, &question.question) {
        (Key::Table { .. }, ..) => Box::new(TableAnswer::new(question, answer)?),
        (Key::FirstHits { hits, alternatives }, Answer::Hits(answers), Question::Hit(table)) => {
            Box::new(FirstHits {
                scale: scale::of_picture(table),
                hits,
                alternatives,
                answers,
            })
        }
        (Key::SpreadEvenly { max_chi_squared }, Answer::Directions(answer), _) => {
            Box::new(Spread {
                max_chi_squared: *max_chi_squared,
                answer,
            })
        }
        (Key::Tree { .. }, Answer::Tree(answer), _) => Box::new(TreeAnswer {
            criteria: TreeCriteria::of(question)?,
            answer,
        }),
        (
            Key::Radiance {
                pixels,
                max_wrong_pixels: allowed,
            },
            Answer::Picture(answer),
            _,
        ) => Box::new(Radiance {
            pixels,
            max_wrong_pixels: *allowed,
            answer,
        }),
        // Unreachable: an exam whose key doesn't fit its question is rejected when it is loaded.
        (
            Key::FirstHits { .. }
            | Key::SpreadEvenly { .. }
            | Key::Tree { .. }
            | Key::Radiance { .. },
            ..,
        ) => return None,
    })
}
