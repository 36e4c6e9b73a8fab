//! Items about the values that are returned for a hit.

use judging::symptom::Symptom;

use super::{is_steep, is_well_inside, questions};
use crate::domains::fields::{EVERY_SIZE, USUAL};
use crate::domains::triangle::Plane;
use crate::items::{Declaration, groups};

/// Returns whether the ray comes from the front.
fn is_from_the_front(plane: &Plane) -> bool {
    is_from_either_side(plane) && plane.slope < 0.0
}

/// Returns whether the ray passes well inside the triangle or well outside it.
fn is_from_either_side(plane: &Plane) -> bool {
    is_steep(plane) && is_well_inside(plane)
}

pub(super) const POSITION: Declaration = Declaration {
    id: "triangle.position",
    title: "the position is the point where the ray hits the triangle",
    look: "The position is the point on the ray at t, or the weighted sum of the corners, which is \
        the same point.",
    look_fits: &[Symptom::of("position")],
    section: "triangle.md#what-to-return",
    tests: &["`distance` is the…"],
    questions: |rng| questions(rng, &["position"], EVERY_SIZE, is_from_the_front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const NORMAL: Declaration = Declaration {
    id: "triangle.normal",
    title: "the normal is interpolated between the corners' normals",
    look: "The normal is w · n0 + u · n1 + v · n2, where n0, n1 and n2 are the normals given at \
        p0, p1 and p2, and w = 1 − u − v. The normal of the flat face is not used, and the result \
        is not turned toward the ray.",
    look_fits: &[Symptom::of("normal")],
    section: "triangle.md#interpolate-the-given-normals",
    tests: &["`normal` and `uv`…"],
    questions: |rng| questions(rng, &["normal"], USUAL, is_from_the_front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const UV: Declaration = Declaration {
    id: "triangle.uv",
    title: "uv is interpolated between the corners' texture coordinates",
    look: "The uv is w · uv0 + u · uv1 + v · uv2, where uv0, uv1 and uv2 are given at p0, p1 and \
           p2, and w = 1 − u − v. The barycentric u and v are only its weights.",
    look_fits: &[Symptom::of("uv")],
    section: "triangle.md#each-weight-belongs-to-its-corner",
    tests: &["`normal` and `uv`…"],
    questions: |rng| questions(rng, &["uv"], EVERY_SIZE, is_from_the_front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const UV_CORNERS: Declaration = Declaration {
    id: "triangle.uv_corners",
    title: "near a corner, that corner's texture coordinates dominate",
    look: "Close to a corner, that corner's weight is nearly 1 and the other two are nearly 0. w \
           = 1 − u − v belongs to p0, u to p1 and v to p2.",
    look_fits: &[Symptom::of("uv")],
    section: "triangle.md#each-weight-belongs-to-its-corner",
    tests: &["`normal` and `uv`…"],
    questions: |rng| {
        questions(rng, &["uv"], USUAL, |plane| {
            // The point may be close to an edge, where small weights matter.
            if plane.is_inside() {
                let is_near_a_corner = plane.weights.iter().any(|&weight| weight > 0.8);
                is_near_a_corner && is_steep(plane) && plane.slope < 0.0
            } else {
                is_from_the_front(plane)
            }
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const NORMAL_FROM_BEHIND: Declaration = Declaration {
    id: "triangle.normal_from_behind",
    title: "the normal stays the same when the triangle is seen from behind",
    look: "The normal belongs to the surface, not to the ray, so it is never flipped toward the \
           ray.",
    look_fits: &[Symptom::reversed("normal")],
    section: "triangle.md#do-not-flip-the-normal",
    tests: &["Do not flip the normal…"],
    questions: |rng| questions(rng, &["normal"], USUAL, is_from_either_side),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const ORIGIN_AND_MATERIAL: Declaration = Declaration {
    id: "triangle.origin_and_material",
    title: "the trace contains the ray's origin and the triangle's shape",
    look: "Copy both: the origin from the ray, and the shape's number from the triangle.",
    look_fits: &[Symptom::of("origin"), Symptom::of("shape")],
    section: "triangle.md#what-to-return",
    tests: &["`distance` is the…"],
    questions: |rng| questions(rng, &["origin", "shape"], EVERY_SIZE, is_from_either_side),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};
