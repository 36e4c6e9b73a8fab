//! The aspects of calls to `BBox::hit`.

use glam::{DVec3, Vec3};
use protocol::Interval;

use super::call::BoxCall;
use super::history;
use crate::domains::fields::{
    DISTANCES, OCTANTS, SIZES, class_below, distance_class, octant, range_class, size_class,
};
use crate::domains::{Aspect, Call};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;

/// The aspects of boxes.
pub(super) const SUBJECT_ASPECTS: &[Aspect<BoxCall>] = &[
    Aspect::SIZE,
    Aspect::PLACE,
    Aspect::OCTANT,
    FORM,
    // Boxes that have exactly the same length along two axes but a different length along the
    // third.
    Aspect::new("square", &["across x", "across y", "across z"], |call| {
        let sides = call.bounds.max - call.bounds.min;
        (0..3).find(|&axis| {
            let [one, other] = [sides[(axis + 1) % 3], sides[(axis + 2) % 3]];
            one == other && one > 0.0 && ![0.0, one].contains(&sides[axis])
        })
    }),
    // Half of the shortest side of a box that isn't flat.
    Aspect::new("shortest side", SIZES, |call| {
        let shortest = (call.bounds.max - call.bounds.min).min_element();
        (shortest > 0.0).then(|| size_class(0.5 * shortest))
    }),
    // The number of axes along which a face of the box is at coordinate 0.
    Aspect::new(
        "sides at 0",
        &["along one axis", "along all axes"],
        |call| {
            let Bounds { min, max } = call.bounds;
            let is_zero = min.cmpeq(DVec3::ZERO) | max.cmpeq(DVec3::ZERO);
            match is_zero.bitmask().count_ones() {
                1 => Some(0),
                3 => Some(1),
                _ => None,
            }
        },
    ),
];

/// The aspects of rays and times.
pub(super) const CALL_ASPECTS: &[Aspect<BoxCall>] = &[
    // The start of the ray.
    Aspect::new(
        "start",
        &[
            "up to 3 sizes away",
            "up to 30 sizes away",
            "inside",
            "on a face",
        ],
        |call| {
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
    ),
    // The position inside the box where the ray starts.
    Aspect::new(
        "start in the box",
        &["in the centre", "on an edge", "in a corner", "elsewhere"],
        |call| {
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
    ),
    // The octant of the box, if the ray starts at the world's origin and the origin is outside the
    // box.
    Aspect::new("octant, from the origin of the world", OCTANTS, |call| {
        let is_from_there = call.ray.origin == Vec3::ZERO && !call.starts_inside();
        is_from_there
            .then(|| octant(call.bounds.center()))
            .flatten()
    }),
    // How many of the start's coordinates are 0.
    Aspect::new("zeros in the start", &["one", "two"], |call| {
        match call.ray.origin.cmpeq(Vec3::ZERO).bitmask().count_ones() {
            1 => Some(0),
            2 => Some(1),
            _ => None,
        }
    }),
    // How far away the ray enters the box.
    Aspect::new("distance", DISTANCES, |call| {
        Some(distance_class(call.bounds.span(&call.ray64())?.0))
    }),
    // How the ray's line crosses the box, and whether it enters and leaves the box within the
    // times.
    Aspect::new(
        "outcome",
        &[
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
        |call| {
            let line =
                Ray64::from(&call.ray).within(Interval::new(f32::NEG_INFINITY, f32::INFINITY));
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
    ),
    // The distance from the box's centre to a ray that hits the box.
    Aspect::new(
        "way past the centre",
        &[
            "near",
            "farther away",
            "near an edge or a corner",
            "next to a corner",
        ],
        |call| {
            call.is_hit()
                .then(|| class_below(&[0.4, 0.83, CORNER], call.distance_of_line()))
        },
    ),
    Aspect::DIRECTION,
    Aspect::DIAGONAL,
    // The components of the direction that are almost 0, if they decide the answer.
    Aspect::new(
        "components below 1e-4",
        &[
            "lead into the box",
            "lead past the box",
            "below 3e-6, into the box",
            "below 3e-6, past the box",
        ],
        |call| {
            let components = call.ray.dir.abs().to_array().into_iter();
            let least = components.filter(|it| *it > 0.0).fold(1.0, f32::min);
            let is_missed = usize::from(!call.is_hit());
            let class = 2 * usize::from(least < 3e-6) + is_missed;
            call.is_decided_by_slant().then_some(class)
        },
    ),
    Aspect::new("times", TIMES_CLASSES, |call| times_class(call.times)),
    // The part of a ray's path through a distant box that falls within `times`, if that part is
    // short.
    Aspect::new(
        "part of the way through",
        &[
            "its beginning, in a distant box",
            "its end, in a distant box",
        ],
        |call| {
            let (enter, leave) = call.crossing()?;
            let (from, to) = call.bounds.span(&call.ray64())?;
            let is_short = to - from < 0.1 * call.size() && leave - enter > 0.3 * call.size();
            if !is_short || enter < DISTANT * call.size() {
                return None;
            }
            Some(usize::from(from > enter))
        },
    ),
    // The range of the ray, which must be ignored.
    Aspect::new("the ray's own range", RANGE_CLASSES, |call| {
        times_class(call.ray.range)
    }),
    // The previous call.
    Aspect::new("call before", history::CLASSES, |call| {
        Some(history::class_of(call))
    }),
];

/// The shape of the box: flat, thin or thick.
const FORM: Aspect<BoxCall> = Aspect::new(
    "form",
    &[
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
    |call| {
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
);

/// The class of flat boxes that are thin as well.
const FLAT_AND_THIN: usize = 5;
/// A box is thin if its shortest side is below this fraction of its longest side.
pub(super) const THIN: f64 = 0.02;
/// A box is thin along two axes if its second longest side is below this fraction of its longest
/// side.
pub(super) const THREAD: f64 = 0.0025;
/// A box is as thin as paper if its shortest side is below this fraction of its longest side.
const PAPER: f64 = 0.0009;

/// A box is as thin as foil if its shortest side is below this fraction of its longest side.
pub(super) const FOIL: f64 = 1.8e-4;

/// The minimum distance from the centre to a ray that passes next to a corner, as a multiple of
/// half the diagonal.
pub(super) const CORNER: f64 = 0.953;

/// A box counts as distant from this distance on, as a multiple of its size.
pub(super) const DISTANT: f64 = 15.0;

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
const TIMES_CLASSES: &[&str] = RANGE_CLASSES.split_at(8).0;

/// The classes of ranges. Unlike times, the range of a ray can be empty.
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
