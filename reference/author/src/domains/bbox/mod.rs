//! The domain of `BBox::hit`.

mod call;
mod clear;
mod draw;
mod history;

use glam::{DVec3, Vec3};
use protocol::Interval;

use self::call::calls;
use self::history::{HARDLY_MOVED, HARDLY_TURNED};
use super::fields::{DISTANCES, OCTANTS, SIZES, distance_class, octant, range_class, size_class};
use super::{Aspect, Call, FunctionDomain, not_asked};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;

pub use call::BoxCall;
pub use draw::{lines_and_a_point, tables};

/// The domain of `BBox::hit`.
pub static BOX: FunctionDomain<BoxCall> = FunctionDomain {
    function: "BBox::hit",
    subject_aspects: &[
        Aspect::SIZE,
        Aspect::PLACE,
        Aspect::OCTANT,
        FORM,
        SQUARE,
        SHORTEST_SIDE,
        ZERO_SIDES,
    ],
    aspects: &[
        START,
        START_INSIDE,
        START_AT_THE_ORIGIN,
        ZEROS_OF_START,
        DISTANCE,
        OUTCOME,
        WAY,
        Aspect::DIRECTION,
        Aspect::DIAGONAL,
        SLANT,
        TIMES,
        SHORT_TIMES,
        RAYS_RANGE,
        HISTORY,
    ],
    pairs: &[
        ["size", "direction"],
        ["size", "start"],
        ["form", "way past the centre"],
    ],
    fields: &[],
    calls,
    not_asked: &[
        not_asked(&["distance"], &[], &["`None`"], "A miss has no distance."),
        not_asked(
            &["call before"],
            &[HARDLY_TURNED, HARDLY_MOVED],
            &["`None`"],
            "A change this small doesn't turn a clear hit into a clear miss.",
        ),
        not_asked(
            &["outcome"],
            &["misses", "too late", "too early"],
            &[],
            "The rays in this class miss the box.",
        ),
        not_asked(
            &["outcome"],
            &[
                "enters and leaves",
                "only leaves",
                "only enters",
                "inside throughout",
            ],
            &["`None`"],
            "The rays in this class hit the box.",
        ),
        not_asked(
            &["size"],
            &["500"],
            &["pairs"],
            "In a scene whose coordinates only go up to 1,000, nothing is 30 box sizes away from a \
                box of this size.",
        ),
        not_asked(
            &["outcome"],
            &[
                "narrowly misses",
                "narrowly misses a flat box",
                "narrowly misses a flat strip",
            ],
            &[],
            "The rays in this class miss the box.",
        ),
        not_asked(
            &["form"],
            &["a line", "a point"],
            &["some", "interval inside the box", "pairs"],
            "If a box is only a line or a point, rounding decides whether a ray hits it.",
        ),
        not_asked(
            &["start in the box"],
            &[],
            &["`None`"],
            "A ray that starts in the box misses it only because of its times.",
        ),
        not_asked(
            &["way past the centre", "part of the way through"],
            &[],
            &["`None`"],
            "The rays in this class hit the box.",
        ),
        not_asked(
            &["components below 1e-4"],
            &["lead into the box", "below 3e-6, into the box"],
            &["`None`"],
            "The rays in this class hit the box.",
        ),
        not_asked(
            &["components below 1e-4"],
            &["lead past the box", "below 3e-6, past the box"],
            &["some", "interval inside the box"],
            "The rays in this class miss the box.",
        ),
        not_asked(
            &["start"],
            &["on a face"],
            &["pairs"],
            "Far from the origin, no coordinate of a tiny box is exact enough.",
        ),
    ],
};

/// The shape of the box: flat, thin or thick.
const FORM: Aspect<BoxCall> = Aspect {
    name: "form",
    classes: &[
        "about a cube",
        "ordinary",
        "thin",
        "thin as paper",
        "thin along two axes",
        "flat and thin",
        "flat along x",
        "flat along y",
        "flat along z",
        "thin as foil",
        "exactly a cube",
        "a line",
        "a point",
    ],
    class: |call| {
        let sides = call.bounds.max - call.bounds.min;
        match sides.cmpeq(DVec3::ZERO).bitmask().count_ones() {
            3 => return Some(12),
            2 => return Some(11),
            _ if sides == DVec3::splat(sides.x) => return Some(10),
            _ => {}
        }
        let flat = (0..3).find(|&axis| sides[axis] == 0.0);
        let mut parts = (sides / sides.max_element()).to_array();
        parts.sort_by(f64::total_cmp);
        let [least, middle, _] = parts;
        let class = match (flat, least) {
            (Some(_), _) if middle < THREAD => FLAT_AND_THIN,
            (Some(axis), _) => 6 + axis,
            (None, _) if middle < THREAD => 4,
            (None, 0.75..) => 0,
            (None, THIN..) => 1,
            (None, PAPER..) => 2,
            (None, FOIL..) => 3,
            (None, _) => 9,
        };
        Some(class)
    },
};

/// Boxes that have exactly the same length along two axes but a different length along the third.
const SQUARE: Aspect<BoxCall> = Aspect {
    name: "square",
    classes: &["across x", "across y", "across z"],
    class: |call| {
        let sides = call.bounds.max - call.bounds.min;
        (0..3).find(|&axis| {
            let [one, other] = [sides[(axis + 1) % 3], sides[(axis + 2) % 3]];
            one == other && one > 0.0 && ![0.0, one].contains(&sides[axis])
        })
    },
};

/// Half of the shortest side of a box that isn't flat.
const SHORTEST_SIDE: Aspect<BoxCall> = Aspect {
    name: "shortest side",
    classes: SIZES,
    class: |call| {
        let shortest = (call.bounds.max - call.bounds.min).min_element();
        (shortest > 0.0).then(|| size_class(0.5 * shortest))
    },
};

/// The class of flat boxes that are thin as well.
const FLAT_AND_THIN: usize = 5;
/// A box is thin if its shortest side is below this fraction of its longest side.
const THIN: f64 = 0.02;
/// A box is thin along two axes if its second longest side is below this fraction of its longest
/// side.
const THREAD: f64 = 0.0025;
/// A box is as thin as paper if its shortest side is below this fraction of its longest side.
const PAPER: f64 = 0.0009;

/// A box is as thin as foil if its shortest side is below this fraction of its longest side.
const FOIL: f64 = 1.8e-4;

/// The number of axes along which a face of the box is at coordinate 0.
const ZERO_SIDES: Aspect<BoxCall> = Aspect {
    name: "sides at 0",
    classes: &["along one axis", "along all axes"],
    class: |call| {
        let Bounds { min, max } = call.bounds;
        let is_zero = min.cmpeq(DVec3::ZERO) | max.cmpeq(DVec3::ZERO);
        match is_zero.bitmask().count_ones() {
            1 => Some(0),
            3 => Some(1),
            _ => None,
        }
    },
};

/// The start of the ray.
const START: Aspect<BoxCall> = Aspect {
    name: "start",
    classes: &[
        "up to 3 sizes away",
        "up to 30 sizes away",
        "inside",
        "on a face",
    ],
    class: |call| {
        if call.size() == 0.0 {
            return None;
        }
        let start = call.ray.origin.as_dvec3();
        let sizes = (start - call.bounds.center()).abs().max_element() / call.size();
        Some(match sizes {
            _ if call.bounds.contains(&Bounds::around([start])) => {
                let is_on_face = start.cmpeq(call.bounds.min) | start.cmpeq(call.bounds.max);
                2 + usize::from(is_on_face.any() && !call.is_flat())
            }
            ..3.0 => 0,
            _ => 1,
        })
    },
};

/// The position inside the box where the ray starts.
const START_INSIDE: Aspect<BoxCall> = Aspect {
    name: "start in the box",
    classes: &["in the centre", "on an edge", "in a corner", "elsewhere"],
    class: |call| {
        let start = call.ray.origin.as_dvec3();
        if call.is_flat() || !call.starts_inside() {
            return None;
        }
        Some(match call.faces_at_start() {
            _ if start == call.bounds.center() => 0,
            2 => 1,
            3 => 2,
            _ => 3,
        })
    },
};

/// The octant of the box, if the ray starts at the world's origin and the origin is outside the
/// box.
const START_AT_THE_ORIGIN: Aspect<BoxCall> = Aspect {
    name: "octant, from the origin of the world",
    classes: OCTANTS,
    class: |call| {
        let is_from_there = call.ray.origin == Vec3::ZERO && !call.starts_inside();
        is_from_there
            .then(|| octant(call.bounds.center()))
            .flatten()
    },
};

/// How many of the start's coordinates are 0.
const ZEROS_OF_START: Aspect<BoxCall> = Aspect {
    name: "zeros in the start",
    classes: &["one", "two"],
    class: |call| match call.ray.origin.cmpeq(Vec3::ZERO).bitmask().count_ones() {
        1 => Some(0),
        2 => Some(1),
        _ => None,
    },
};

/// The distance at which the ray enters the box.
const DISTANCE: Aspect<BoxCall> = Aspect {
    name: "distance",
    classes: DISTANCES,
    class: |call| Some(distance_class(call.bounds.span(&call.ray64())?.0)),
};

/// How the ray's line crosses the box, and whether it enters and leaves the box within the times.
const OUTCOME: Aspect<BoxCall> = Aspect {
    name: "outcome",
    classes: &[
        "enters and leaves",
        "only leaves",
        "only enters",
        "inside throughout",
        "misses",
        "too late",
        "too early",
        "narrowly misses",
        "narrowly misses a flat box",
        "narrowly misses a flat strip",
    ],
    class: |call| {
        let line = Ray64::from(&call.ray).within(Interval::new(f32::NEG_INFINITY, f32::INFINITY));
        let (min, max) = (f64::from(call.times.min), f64::from(call.times.max));
        Some(match call.bounds.span(&line) {
            None if call.is_narrow_miss(&line) => match (call.is_flat(), (FORM.class)(call)) {
                (false, _) => 7,
                (true, Some(FLAT_AND_THIN)) => 9,
                (true, _) => 8,
            },
            None => 4,
            Some((enter, _)) if enter > max => 5,
            Some((_, leave)) if leave < min => 6,
            Some((enter, leave)) => match (enter >= min, leave <= max) {
                (true, true) => 0,
                (false, true) => 1,
                (true, false) => 2,
                (false, false) => 3,
            },
        })
    },
};

/// The distance from the box's centre to a ray that hits the box.
const WAY: Aspect<BoxCall> = Aspect {
    name: "way past the centre",
    classes: &[
        "near",
        "farther away",
        "near an edge or a corner",
        "next to a corner",
    ],
    class: |call| {
        call.is_hit().then(|| match call.distance_of_line() {
            ..0.4 => 0,
            ..0.83 => 1,
            ..CORNER => 2,
            _ => 3,
        })
    },
};

/// The minimum distance from the centre to a ray that passes next to a corner, as a multiple of
/// half the diagonal.
const CORNER: f64 = 0.953;

/// The part of a ray's path through a distant box that falls within `times`, if that part is short.
const SHORT_TIMES: Aspect<BoxCall> = Aspect {
    name: "part of the way through",
    classes: &[
        "its beginning, in a distant box",
        "its end, in a distant box",
    ],
    class: |call| {
        let (enter, leave) = call.crossing()?;
        let (from, to) = call.bounds.span(&call.ray64())?;
        let is_short = to - from < 0.1 * call.size() && leave - enter > 0.3 * call.size();
        if !is_short || enter < DISTANT * call.size() {
            return None;
        }
        Some(usize::from(from > enter))
    },
};

/// The minimum distance at which a box counts as distant, as a multiple of its size.
const DISTANT: f64 = 15.0;

/// The components of the direction that are almost 0, if they decide the answer.
const SLANT: Aspect<BoxCall> = Aspect {
    name: "components below 1e-4",
    classes: &[
        "lead into the box",
        "lead past the box",
        "below 3e-6, into the box",
        "below 3e-6, past the box",
    ],
    class: |call| {
        let components = call.ray.dir.abs().to_array().into_iter();
        let least = components.filter(|it| *it > 0.0).fold(1.0, f32::min);
        let is_missed = usize::from(!call.is_hit());
        let class = 2 * usize::from(least < 3e-6) + is_missed;
        call.is_decided_by_slant().then_some(class)
    },
};

/// The times.
const TIMES: Aspect<BoxCall> = Aspect {
    name: "times",
    classes: TIMES_CLASSES,
    class: |call| times_class(call.times),
};

/// The range of the ray, which must be ignored.
const RAYS_RANGE: Aspect<BoxCall> = Aspect {
    name: "the ray's own range",
    classes: RANGE_CLASSES,
    class: |call| times_class(call.ray.range),
};

/// Returns the class of an interval in [`RANGE_CLASSES`].
fn times_class(times: Interval) -> Option<usize> {
    match times {
        _ if times.min > times.max => Some(8),
        _ if times.min == times.max => Some(7),
        _ if times.max == f32::MAX => Some(6),
        _ => range_class(times),
    }
}

/// The classes of times.
const TIMES_CLASSES: &[&str] = &[
    "from 0 to ∞",
    "from 0 to a nearby end",
    "from a later start to ∞",
    "from a later start to a nearby end",
    "from 0 to a distant end",
    "from a later start to a distant end",
    "to the largest number",
    "one point",
];

/// The classes in [`TIMES_CLASSES`], and an additional class for empty ranges.
const RANGE_CLASSES: &[&str] = &[
    "from 0 to ∞",
    "from 0 to a nearby end",
    "from a later start to ∞",
    "from a later start to a nearby end",
    "from 0 to a distant end",
    "from a later start to a distant end",
    "to the largest number",
    "one point",
    "empty",
];

/// The previous call.
const HISTORY: Aspect<BoxCall> = Aspect {
    name: "call before",
    classes: history::CLASSES,
    class: |call| Some(history::class_of(call)),
};
