//! Items about the interval of times during which a box can be hit.

use judging::symptom::Symptom;

use super::{is_ordinary, questions};
use crate::domains::fields::{EVERY_SIZE, USUAL};
use crate::items::{Declaration, groups};
use crate::oracle::Ray64;

pub(super) const BEHIND: Declaration = Declaration {
    id: "bbox.behind",
    title: "a box ahead of the ray is hit, and one behind it is missed",
    look: "If a box is behind the origin, its times are negative, so no part of the ray's path \
        through it is within `times`. An interval that would end before it begins is a miss too.",
    look_fits: &[Symptom::HIT],
    section: "boxes.md#use-times-and-not-the-range-of-the-ray",
    tests: &["Returns the part…"],
    questions: |rng| {
        questions(rng, USUAL, |call| {
            is_ordinary(call) && call.is_unlimited() && !call.starts_inside()
        })
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const FROM_INSIDE: Declaration = Declaration {
    id: "bbox.from_inside",
    title: "if the ray starts inside the box, the interval starts at times.min",
    look: "A ray that starts inside the box entered it at a negative time: clip the interval to \
        `times`.",
    look_fits: &[Symptom::MISS, Symptom::of("interval inside the box")],
    section: "boxes.md#clip-the-result-to-times",
    tests: &["The result is clipped…"],
    questions: |rng| {
        questions(rng, USUAL, |call| {
            let is_hit = call.ray64().max == f64::INFINITY && call.starts_inside();
            is_ordinary(call) && (is_hit || call.crossing().is_none())
        })
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const CLIPPED: Declaration = Declaration {
    id: "bbox.clipped",
    title: "the interval is the part of the given times when the ray is in the box",
    look: "Clip the interval at both ends. If the ray's line passes through the box, it is a miss \
           only if the box is entered after times.max or left before times.min.",
    section: "boxes.md#clip-the-result-to-times",
    tests: &["The result is clipped…"],
    questions: |rng| {
        questions(rng, EVERY_SIZE, |call| {
            is_ordinary(call) && !call.is_unlimited() && call.crossing().is_some()
        })
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const WHOLLY_INSIDE: Declaration = Declaration {
    id: "bbox.wholly_inside",
    title: "if the ray is in the box the whole time, the given times are returned unchanged",
    look: "If the ray is inside the box throughout `times`, it doesn't cross any of the box's \
        planes in that time, but it is still a hit, from times.min to times.max.",
    look_fits: &[Symptom::MISS, Symptom::of("interval inside the box")],
    section: "boxes.md#a-range-wholly-inside-the-box-is-a-hit",
    tests: &["The result is clipped…"],
    questions: |rng| {
        questions(rng, USUAL, |call| {
            let ray64 = call.ray64();
            let is_inside = |(enter, leave)| enter < ray64.min && ray64.max < leave;
            let is_hit = call.bounds.span(&ray64).is_some();
            is_ordinary(call) && (!is_hit || call.crossing().is_some_and(is_inside))
        })
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const TIMES_NOT_RANGE: Declaration = Declaration {
    id: "bbox.times_not_range",
    title: "the given times are used, not the ray's own range",
    look: "BBox::hit uses only the times that it is given; ray.range is up to the caller.",
    section: "boxes.md#use-times-and-not-the-range-of-the-ray",
    tests: &["Use `times` and ignore…"],
    questions: |rng| {
        questions(rng, USUAL, |call| {
            let by_range = call.bounds.span(&Ray64::from(&call.ray));
            let by_times = call.bounds.span(&call.ray64());
            is_ordinary(call) && by_range.is_some() != by_times.is_some()
        })
    },
    ..Declaration::in_group(groups::BOXES)
};
