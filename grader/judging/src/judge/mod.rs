//! Comparing answers with keys: pure, and the only way to points.

mod blemish;
mod deviation;
mod first_hits;
mod hits;
mod measure;
mod radiance;
mod rays;
mod share;
mod spans;
mod threshold;
pub mod tree;

use protocol::{Answer, Outcome, Panic, Samples};

use crate::exam::{Asked, Key};

use first_hits::FirstHits;
use hits::Hits;
use radiance::Radiance;
use rays::CameraRays;
use spans::Spans;
use tree::Built;

pub use blemish::{Aspect, Blemish};
pub use deviation::{Deviation, Measured};
pub use share::Share;
pub use threshold::Threshold;

/// What became of one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// How much of the item's points it allows.
    pub share: Share,
    /// What is wrong first, if anything is.
    pub failure: Option<Failure>,
}

/// The first element of a question that went wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Which element of the question, counted from 0.
    pub element: usize,
    /// How.
    pub how: How,
    /// How many elements are wrong, and of how many, where they were counted.
    pub count: Option<(usize, usize)>,
}

/// How an element went wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
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
        share: Share::ALL,
        failure: None,
    };

    fn wrong(failure: Failure) -> Self {
        Judgement {
            share: Share::NONE,
            failure: Some(failure),
        }
    }

    fn protocol(why: &str) -> Self {
        Judgement::wrong(Failure {
            element: 0,
            how: How::Protocol(why.to_owned()),
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
    fn measure(&self) -> Vec<Measured>;

    /// What is wrong at each position, if this is a picture: something at a position that costs,
    /// nothing at one that does not.
    fn blemishes(&self) -> Option<Vec<Option<Blemish>>> {
        None
    }
}

/// Judges the answer to one question.
pub fn judge(asked: &Asked, answer: &Answer) -> Judgement {
    match comparison(asked, answer) {
        Some(comparison) => comparison.judge(),
        None => Judgement::protocol("an answer of another kind"),
    }
}

/// How far off the answer to one question is: by the same numbers that decide in [`judge`].
pub fn measure(asked: &Asked, answer: &Answer) -> Vec<Measured> {
    match comparison(asked, answer) {
        Some(comparison) => comparison.measure(),
        None => deviation::worst([Deviation::WRONG]),
    }
}

/// What is wrong at each position of a picture, in the order of asking, by the same numbers that
/// decide in [`judge`]. None where no picture was asked for, or none of its size came.
pub fn blemishes(asked: &Asked, answer: &Answer) -> Option<Vec<Option<Blemish>>> {
    comparison(asked, answer)?.blemishes()
}

fn comparison<'a>(asked: &'a Asked, answer: &'a Answer) -> Option<Box<dyn Comparison + 'a>> {
    use protocol::Question as Q;

    Some(match (&asked.key, answer, &asked.question) {
        (Key::Rays { judged, directions }, Answer::Rays(rays), Q::Camera { samples, .. }) => {
            Box::new(CameraRays {
                judged,
                directions,
                rays,
                counted: matches!(samples, Samples::EveryPixel),
            })
        }
        (
            Key::Hits { judged, hits },
            Answer::Hits(answers),
            Q::Shapes { rays, .. } | Q::Traverse { rays, .. } | Q::BuildAndTraverse { rays, .. },
        ) => Box::new(Hits {
            judged,
            rays: rays.to_vec(),
            hits,
            answers,
        }),
        (Key::FirstHits { hits, also }, Answer::Hits(answers), _) => Box::new(FirstHits {
            hits,
            also,
            answers,
        }),
        (Key::Spans { spans }, Answer::Spans(answers), _) => Box::new(Spans { spans, answers }),
        (
            Key::Tree { judged, sweep_cost },
            Answer::Tree(answer),
            Q::Build {
                shapes,
                max_leaf_size,
            },
        ) => Box::new(Built {
            judged,
            sweep_cost: *sweep_cost,
            shapes,
            max_leaf_size: *max_leaf_size,
            answer,
        }),
        (Key::Radiance { pixels, allowed }, Answer::Picture(answer), _) => Box::new(Radiance {
            pixels,
            allowed: *allowed,
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
fn table<T>(
    outcomes: &[Outcome<T>],
    wanted: usize,
    wrong: impl Fn(usize, &T) -> Option<How>,
) -> Judgement {
    if outcomes.len() != wanted {
        return Judgement::protocol("another number of answers than of questions");
    }
    let mut failures = outcomes
        .iter()
        .enumerate()
        .filter_map(|(element, outcome)| {
            let how = match outcome {
                Outcome::Value(value) => wrong(element, value),
                Outcome::Panicked(panic) => Some(How::Panicked(panic.clone())),
                // Given up only after panics, which come first.
                Outcome::GivenUp => Some(How::Protocol("given up".to_owned())),
            };
            Some((element, how?))
        });
    match failures.next() {
        None => Judgement::RIGHT,
        Some((element, how)) => Judgement::wrong(Failure {
            element,
            how,
            count: Some((1 + failures.count(), wanted)),
        }),
    }
}

/// Measures a table: `of_value` tells how far off a value is, given its place in the table.
fn table_measured<T>(
    outcomes: &[Outcome<T>],
    wanted: usize,
    of_value: impl Fn(usize, &T) -> Vec<Deviation>,
) -> Vec<Measured> {
    if outcomes.len() != wanted {
        return deviation::worst([Deviation::WRONG]);
    }
    let elements = outcomes.iter().enumerate();
    deviation::worst(elements.flat_map(|(element, outcome)| {
        deviation::of_outcome(outcome, |value| of_value(element, value))
    }))
}
