//! Items about which of the two roots is the hit, if either of them is.

use judging::symptom::Symptom;

use super::questions;
use crate::domains::fields::{EVERY_SIZE, TINY, USUAL};
use crate::domains::sphere::Line;
use crate::items::{Declaration, groups, paper};

/// Returns true if the ray is unlimited and its line either misses the sphere or enters it ahead of
/// the ray's start.
fn is_ahead(line: &Line) -> bool {
    line.is_unlimited() && (line.misses() || line.roots[0] > 0.0)
}

pub(super) const NEAR_SIDE: Declaration = Declaration {
    id: "sphere.near_side",
    title: "a ray from outside hits the near side",
    look: "Work out both roots by hand for the ray shown, using the same form of the formula \
           throughout, and compare them with the values in your code. From outside, the smaller \
           root is the distance. A negative discriminant means a miss.",
    section: "sphere.md#the-quadratic-equation",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        let drawn = questions(rng, &["distance"], USUAL, is_ahead);
        [vec![paper::sphere(rng)], drawn].concat()
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const BESIDE: Declaration = Declaration {
    id: "sphere.beside",
    title: "rays through the sphere hit it, and rays past it miss it",
    look: "Without real roots, there is no hit. With two roots, there may be a hit. Work out the \
        value under the square root for the ray shown, before you take the root.",
    look_fits: &[Symptom::HIT],
    section: "sphere.md#the-square-root-of-a-negative-number",
    tests: &["Returns the ray's…"],
    questions: |rng| questions(rng, &[], USUAL, is_ahead),
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RADIUS: Declaration = Declaration {
    id: "sphere.radius",
    title: "a sphere of any radius is hit like any other",
    look: "Work out both roots by hand for the ray shown. Spheres can be tiny, and so can distances: \
           which of the two roots is the smallest one in ray.range, and which distance do you return?",
    look_fits: &[Symptom::of("distance")],
    section: "sphere.md#the-near-root-can-be-out-of-range",
    tests: &["Returns the ray's…", "`distance` is the…"],
    questions: |rng| {
        let all = [
            "distance",
            "position",
            "normal",
            "unit_normal",
            "uv",
            "origin",
            "shape",
        ];
        let tiny = questions(&mut rng.sequence("sphere.radius.tiny"), &all, TINY, |_| {
            true
        });
        let distances = questions(rng, &["distance"], EVERY_SIZE, |_| true);
        [distances, tiny].concat()
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const BEHIND: Declaration = Declaration {
    id: "sphere.behind",
    title: "a sphere ahead of the ray is hit, and one behind it is missed",
    look: "If the sphere is behind the ray, both roots are negative, so they are outside ray.range. If it \
        is ahead, both are positive. Work out both for the ray shown.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        questions(rng, &["distance"], USUAL, |line| {
            line.is_unlimited() && line.roots[0] * line.roots[1] > 0.0
        })
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const FROM_INSIDE: Declaration = Declaration {
    id: "sphere.from_inside",
    title: "a ray from inside hits the far side",
    look: "From inside, the near root is negative and the far one is positive in every direction. Only the \
        roots and ray.range decide whether there is a hit, and its distance is the root that is in the range.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    tests: &["If only the far intersection…"],
    questions: |rng| {
        questions(rng, &["distance"], USUAL, |line| {
            line.is_unlimited() && (line.misses() || line.roots[0] < 0.0)
        })
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const FAR_ROOT: Declaration = Declaration {
    id: "sphere.far_root",
    title: "if the near side is before the range, the far side can still be hit",
    look: "The range need not start at 0. If the near root is outside the range and the far root \
        is inside it, the distance is the far root.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    tests: &["If only the far intersection…"],
    questions: |rng| {
        questions(rng, &["distance"], EVERY_SIZE, |line| {
            line.ray64.min > line.roots[0]
        })
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RANGE_MAX: Declaration = Declaration {
    id: "sphere.range_max",
    title: "hits beyond the end of the range are ignored",
    look: "Compare each root separately with both ends of ray.range. The ray can end before the \
           sphere, inside it or beyond it: which of the two roots are in the range of the ray \
           shown?",
    section: "sphere.md#check-each-root-separately",
    tests: &["`ray.range` includes both…"],
    questions: |rng| {
        questions(rng, &["distance"], EVERY_SIZE, |line| {
            !line.misses() && line.ray64.min == 0.0 && line.ray64.max.is_finite()
        })
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RANGE_WITHIN: Declaration = Declaration {
    id: "sphere.range_within",
    title: "a ray misses if neither root is in its range, and hits otherwise",
    look: "Between the roots, the ray is inside the sphere and hits nothing. Beyond both, it has \
        left the sphere. A root is a hit if and only if it is in ray.range, even if it is tiny.",
    section: "sphere.md#check-each-root-separately",
    tests: &["`ray.range` includes both…"],
    questions: |rng| {
        questions(rng, &["distance"], EVERY_SIZE, |line| {
            !line.misses() && line.ray64.min > 0.0
        })
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};
