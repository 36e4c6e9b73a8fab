//! Comparing answers with keys: pure, and the only way to points.

mod credit;
mod deviation;
mod first_hits;
mod hits;
mod measure;
mod mismatch;
mod radiance;
mod rays;
mod spans;
mod threshold;
pub mod tree;

use protocol::{Answer, ElementOutcome, Panic, Samples};

use crate::exam::{ExamQuestion, Key};

use first_hits::FirstHits;
use hits::Hits;
use radiance::Radiance;
use rays::CameraRays;
use spans::Spans;
use tree::TreeAnswer;

pub use credit::Credit;
pub use deviation::{Deviation, Measurement};
pub use mismatch::{Aspect, Mismatch};
pub use threshold::Threshold;

/// What became of one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// How much of the item's points it allows.
    pub credit: Credit,
    /// What is wrong first, if anything is.
    pub failure: Option<Failure>,
}

/// The first element of a question that went wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Which element of the question, counted from 0.
    pub element: usize,
    /// How.
    pub kind: FailureKind,
    /// How many elements are wrong, and of how many, where they were counted.
    pub count: Option<(usize, usize)>,
}

/// How an element went wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum FailureKind {
    /// The answer is not right.
    Wrong {
        /// What of it: `distance`, `normal`, ...
        what: String,
        /// As it came.
        got: String,
        /// As it should have come.
        wanted: String,
    },
    /// The submission's code panicked.
    Panicked(Panic),
    /// The bytes are well formed, but no answer to this question.
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

/// An answer beside its key.
trait Comparison {
    /// What it earns, and what is wrong first.
    fn judge(&self) -> Judgement;

    /// How far off it is, in all that it is judged by. All of it is right if and only if the
    /// judgement is that everything counts.
    fn measure(&self) -> Vec<Measurement>;

    /// What is wrong at each position, if this is a picture: something at a position that costs,
    /// nothing at one that does not.
    fn mismatches(&self) -> Option<Vec<Option<Mismatch>>> {
        None
    }
}

/// Judges the answer to one question.
pub fn judge(asked: &ExamQuestion, answer: &Answer) -> Judgement {
    match comparison(asked, answer) {
        Some(comparison) => comparison.judge(),
        None => Judgement::protocol("an answer of another kind"),
    }
}

/// How far off the answer to one question is: by the same numbers that decide in [`judge`].
pub fn measure(asked: &ExamQuestion, answer: &Answer) -> Vec<Measurement> {
    match comparison(asked, answer) {
        Some(comparison) => comparison.measure(),
        None => deviation::worst_by_threshold([Deviation::WRONG]),
    }
}

/// What is wrong at each position of a picture, in the order of asking, by the same numbers that
/// decide in [`judge`]. None where no picture was asked for, or none of its size came.
pub fn mismatches(asked: &ExamQuestion, answer: &Answer) -> Option<Vec<Option<Mismatch>>> {
    comparison(asked, answer)?.mismatches()
}

fn comparison<'a>(asked: &'a ExamQuestion, answer: &'a Answer) -> Option<Box<dyn Comparison + 'a>> {
    use protocol::Question as Q;

    Some(match (&asked.key, answer, &asked.question) {
        (
            Key::Rays {
                checks: judged,
                directions,
            },
            Answer::Rays(rays),
            Q::Camera { samples, .. },
        ) => Box::new(CameraRays {
            checks: judged,
            directions,
            rays,
            is_picture: matches!(samples, Samples::EveryPixel),
        }),
        (
            Key::Hits {
                checks: judged,
                hits,
            },
            Answer::Hits(answers),
            Q::Shapes { rays, .. } | Q::Traverse { rays, .. } | Q::BuildAndTraverse { rays, .. },
        ) => Box::new(Hits {
            checks: judged,
            rays: rays.to_vec(),
            hits,
            answers,
        }),
        (
            Key::FirstHits {
                hits,
                alternatives: also,
            },
            Answer::Hits(answers),
            _,
        ) => Box::new(FirstHits {
            hits,
            alternatives: also,
            answers,
        }),
        (Key::Spans { spans }, Answer::Spans(answers), _) => Box::new(Spans { spans, answers }),
        (
            Key::Tree {
                checks: judged,
                sweep_cost,
            },
            Answer::Tree(answer),
            Q::Build {
                shapes,
                max_leaf_size,
            },
        ) => Box::new(TreeAnswer {
            checks: judged,
            sweep_cost: *sweep_cost,
            shapes,
            max_leaf_size: *max_leaf_size,
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
        // An exam whose key does not fit its question is refused when it is loaded.
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::FirstHits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::Radiance { .. },
            _,
            _,
        ) => return None,
    })
}

/// Judges a table: every element must be right. `wrong` tells what is wrong with a value, given
/// its place in the table.
fn judge_table<T>(
    outcomes: &[ElementOutcome<T>],
    wanted: usize,
    wrong: impl Fn(usize, &T) -> Option<FailureKind>,
) -> Judgement {
    if outcomes.len() != wanted {
        return Judgement::protocol("another number of answers than of questions");
    }
    let mut failures = outcomes
        .iter()
        .enumerate()
        .filter_map(|(element, outcome)| {
            let how = match outcome {
                ElementOutcome::Value(value) => wrong(element, value),
                ElementOutcome::Panicked(panic) => Some(FailureKind::Panicked(panic.clone())),
                // Given up only after panics, which come first.
                ElementOutcome::Skipped => Some(FailureKind::Protocol("given up".to_owned())),
            };
            Some((element, how?))
        });
    match failures.next() {
        None => Judgement::RIGHT,
        Some((element, how)) => Judgement::wrong(Failure {
            element,
            kind: how,
            count: Some((1 + failures.count(), wanted)),
        }),
    }
}

/// Measures a table: `of_value` tells how far off a value is, given its place in the table.
fn measure_table<T>(
    outcomes: &[ElementOutcome<T>],
    wanted: usize,
    of_value: impl Fn(usize, &T) -> Vec<Deviation>,
) -> Vec<Measurement> {
    if outcomes.len() != wanted {
        return deviation::worst_by_threshold([Deviation::WRONG]);
    }
    let elements = outcomes.iter().enumerate();
    deviation::worst_by_threshold(elements.flat_map(|(element, outcome)| {
        deviation::outcome_deviations(outcome, |value| of_value(element, value))
    }))
}
