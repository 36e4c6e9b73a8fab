//! Comparing answers with keys: pure, and the only way to points.

mod first_hits;
mod hits;
mod measure;
mod radiance;
mod rays;
mod share;
mod spans;
mod tree;

use protocol::{Answer, Outcome, Panic, Samples};

use crate::exam::{Asked, Key};

pub use share::Share;

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

/// Judges the answer to one question.
pub fn judge(asked: &Asked, answer: &Answer) -> Judgement {
    use protocol::Question as Q;

    match (&asked.key, answer, &asked.question) {
        (Key::Rays { judged, directions }, Answer::Rays(rays), Q::Camera { samples, .. }) => {
            match samples {
                Samples::List(_) => rays::table_of(judged, directions, rays),
                Samples::EveryPixel => rays::picture(judged, directions, rays),
            }
        }
        (
            Key::Hits { judged, hits },
            Answer::Hits(answers),
            Q::Shapes { rays, .. } | Q::Traverse { rays, .. } | Q::BuildAndTraverse { rays, .. },
        ) => hits::judge(judged, &rays.to_vec(), hits, answers),
        (Key::FirstHits { hits, also }, Answer::Hits(answers), _) => {
            first_hits::judge(hits, also, answers)
        }
        (Key::Spans { spans }, Answer::Spans(answers), _) => spans::judge(spans, answers),
        (
            Key::Tree { judged, sweep_cost },
            Answer::Tree(answer),
            Q::Build {
                shapes,
                max_leaf_size,
            },
        ) => tree::judge(judged, *sweep_cost, shapes, *max_leaf_size, answer),
        (Key::Radiance { pixels, allowed }, Answer::Picture(answer), _) => {
            radiance::judge(pixels, *allowed, answer)
        }
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
        ) => Judgement::protocol("an answer of another kind"),
    }
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
