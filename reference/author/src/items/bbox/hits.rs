//! Items about rays that come from all sides and hit or miss a box.

use judging::symptom::{PRESENCE, Symptom};

use super::{almost_parallel, bbox_question, is_ordinary, questions};
use crate::domains::bbox::BoxCall;
use crate::domains::bbox::lines_and_a_point;
use crate::domains::fields::{EVERY_SIZE, USUAL};
use crate::items::{Declaration, groups, paper};

/// Returns whether the ray starts outside the box and the box isn't behind it.
fn is_ahead(call: &BoxCall) -> bool {
    let enters_ahead = |(enter, _)| enter > 0.0;
    is_ordinary(call) && call.is_unlimited() && call.crossing().is_none_or(enters_ahead)
}

/// Returns whether the ray crosses the slab of each axis.
fn crosses_all_slabs(call: &BoxCall) -> bool {
    (0..3).all(|axis| call.bounds.slab(axis).span(&call.ray64()).is_some())
}

pub(super) const THROUGH: Declaration = Declaration {
    id: "bbox.through",
    title: "rays through the box get the right entry and exit times",
    look: "Work out by hand when the ray shown is between the two planes of each axis. The answer \
        is the interval that these three intervals and the argument `times` have in common, or \
        None if they have nothing in common.",
    section: "boxes.md#from-the-last-entry-to-the-first-exit",
    tests: &["Returns the part…"],
    questions: |rng| {
        let drawn = questions(rng, USUAL, is_ahead);
        let (bounds, queries) = paper::bbox(rng);
        [vec![bbox_question(bounds, queries)], drawn].concat()
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const SLAB_AFTER_SLAB: Declaration = Declaration {
    id: "bbox.slab_after_slab",
    title: "a ray hits the box if it is in all three slabs at the same time",
    look: "Compare the axes with each other, and with `times`: the ray misses if and only if the \
        latest entry comes after the earliest exit, even if all these times are tiny.",
    look_fits: &[Symptom::of(PRESENCE)],
    section: "boxes.md#the-slab-intervals-must-overlap",
    tests: &["Returns the part…"],
    questions: |rng| {
        questions(rng, EVERY_SIZE, |call| {
            is_ahead(call) && crosses_all_slabs(call)
        })
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const OCTANTS: Declaration = Declaration {
    id: "bbox.octants",
    title: "rays in all directions enter and leave at the right times",
    look: "On each axis, the smaller of the two times is the entry, even if the direction is \
        negative. Work out all six times for the ray shown, and clip the last entry and the first \
        exit to the argument `times`.",
    section: "boxes.md#from-the-last-entry-to-the-first-exit",
    tests: &["Returns the part…"],
    questions: |rng| questions(rng, USUAL, is_ordinary),
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const AXIS_PARALLEL: Declaration = Declaration {
    id: "bbox.axis_parallel",
    title: "directions with components of 0, −0 or almost 0 work too",
    look: "A ray that does not move along an axis is either always or never between the planes of \
        that axis. Dividing by zero gives infinities, which are right if your comparisons \
        handle them. A component that is almost 0 still moves the ray.",
    section: "boxes.md#zero-and-minus-zero",
    tests: &["A component of `ray.dir`…", "Then the ray is parallel…"],
    questions: |rng| {
        let sizes = [EVERY_SIZE, EVERY_SIZE].concat();
        let parallel = questions(rng, &sizes, |call| {
            !call.is_flat() && (call.is_parallel() || call.is_decided_by_slant())
        });
        [parallel, vec![almost_parallel::question(rng)]].concat()
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const FLAT: Declaration = Declaration {
    id: "bbox.flat",
    title: "a flat box can be hit",
    look: "The box of an axis-aligned triangle is flat: the ray enters and leaves it at the same \
           time, and that still counts as a hit.",
    look_fits: &[Symptom::MISS],
    section: "boxes.md#flat-boxes-can-be-hit",
    tests: &["A flat box (`min…"],
    questions: |rng| {
        let mut flat = questions(rng, EVERY_SIZE, BoxCall::is_flat);
        let even_flatter = lines_and_a_point(rng).into_iter();
        flat.extend(even_flatter.map(|(bounds, queries)| bbox_question(bounds, queries)));
        flat
    },
    ..Declaration::in_group(groups::BOXES)
};
