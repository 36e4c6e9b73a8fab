//! The domain of `BBox::hit`.

mod aspects;
mod boxes;
mod call;
mod clear;
mod draw;
mod history;
mod queries;

use self::aspects::{CALL_ASPECTS, SUBJECT_ASPECTS};
use self::call::calls;
use self::history::{HARDLY_MOVED, HARDLY_TURNED};
use super::{FunctionDomain, not_asked};

pub use call::BoxCall;
pub use draw::{lines_and_a_point, tables};

/// The domain of `BBox::hit`.
pub static BOX: FunctionDomain<BoxCall> = FunctionDomain {
    aspects: &[SUBJECT_ASPECTS, CALL_ASPECTS],
    pairs: &[
        ["size", "direction"],
        ["size", "start"],
        ["form", "way past the centre"],
    ],
    not_asked: &[
        not_asked(&["distance"])
            .columns(&["`None`"])
            .because("A miss has no distance."),
        not_asked(&["call before"])
            .classes(&[HARDLY_TURNED, HARDLY_MOVED])
            .columns(&["`None`"])
            .because("A change this small doesn't turn a clear hit into a clear miss."),
        not_asked(&["outcome"])
            .classes(&[
                "misses",
                "too late",
                "too early",
                "narrowly misses",
                "narrowly misses a flat box",
                "narrowly misses a flat strip",
            ])
            .because("The rays in this class miss the box."),
        not_asked(&["outcome", "components below 1e-4"])
            .classes(&[
                "enters and leaves",
                "only leaves",
                "only enters",
                "inside throughout",
                "lead into the box",
                "below 3e-6, into the box",
            ])
            .columns(&["`None`"])
            .because("The rays in this class hit the box."),
        not_asked(&["size"])
            .classes(&["500"])
            .columns(&["pairs"])
            .because(
                "In a scene whose coordinates only go up to 1,000, nothing is 30 box sizes away \
                 from a box of this size.",
            ),
        not_asked(&["form"])
            .classes(&["a line", "a point"])
            .columns(&["some", "interval inside the box", "pairs"])
            .because("If a box is only a line or a point, rounding decides whether a ray hits it."),
        not_asked(&["start in the box"])
            .columns(&["`None`"])
            .because("A ray that starts in the box misses it only because of its times."),
        not_asked(&["way past the centre", "part of the way through"])
            .columns(&["`None`"])
            .because("The rays in this class hit the box."),
        not_asked(&["components below 1e-4"])
            .classes(&["lead past the box", "below 3e-6, past the box"])
            .columns(&["some", "interval inside the box"])
            .because("The rays in this class miss the box."),
        not_asked(&["start"])
            .classes(&["on a face"])
            .columns(&["pairs"])
            .because("Far from the origin, no coordinate of a tiny box is exact enough."),
    ],
    ..FunctionDomain::new("BBox::hit", calls)
};
