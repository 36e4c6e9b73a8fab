//! Items about the quantities of a hit.

use protocol::Ray;

use super::aim::{
    Side, hitting_ray, missing_ray, random_triangle, ray_through, shape, weights_inside,
};
use super::table_questions;
use crate::items::{Declaration, groups, shape_question};

pub(super) const POSITION: Declaration = Declaration {
    id: "triangle.position",
    title: "position is the point where the ray hits the triangle",
    look: "It is the ray's point at t, or the weighted sum of the corners: both are the same.",
    section: "triangle.md#what-to-return",
    questions: |rng| table_questions(rng, &["position"], Side::Front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const NORMAL: Declaration = Declaration {
    id: "triangle.normal",
    title: "the normal is interpolated between the corners' normals",
    look: "It is w · n0 + u · n1 + v · n2, where n0, n1 and n2 are the normals given at p0, p1 and \
           p2, and w = 1 − u − v. The normal of the flat face is not used.",
    section: "triangle.md#interpolate-the-given-normals",
    questions: |rng| table_questions(rng, &["normal"], Side::Front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const UV: Declaration = Declaration {
    id: "triangle.uv",
    title: "uv is interpolated between the corners' texture coordinates",
    look: "It is w · uv0 + u · uv1 + v · uv2, where uv0, uv1 and uv2 are given at p0, p1 and p2, \
           and w = 1 − u − v. The barycentric u and v are only its weights.",
    section: "triangle.md#the-weights-are-not-the-texture-coordinates",
    questions: |rng| table_questions(rng, &["uv"], Side::Front),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const UV_CORNERS: Declaration = Declaration {
    id: "triangle.uv_corners",
    title: "near a corner, that corner's texture coordinates count most",
    look: "Close to a corner, that corner's weight is nearly 1 and the two others are nearly 0. w \
           = 1 − u − v belongs to p0, u to p1 and v to p2.",
    section: "triangle.md#each-weight-belongs-to-its-corner",
    questions: |rng| {
        let mut table = || {
            let vertices = random_triangle(rng);
            let mut rays = Vec::new();
            for corner in 0..3 {
                for _ in 0..3 {
                    let mut weights = weights_inside(rng, 0.25).map(|w| 0.2 * w);
                    weights[corner] += 0.8;
                    rays.push(ray_through(rng, &vertices, weights, Side::Front));
                }
                rays.push(missing_ray(rng, &vertices, Side::Front));
            }
            shape_question(&["uv"], shape(&vertices, 0), rays)
        };
        vec![table(), table()]
    },
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const NORMAL_FROM_BEHIND: Declaration = Declaration {
    id: "triangle.normal_from_behind",
    title: "seen from behind, the normal stays as it is",
    look: "The normal belongs to the surface, not to the ray, so it is never flipped toward the \
           ray.",
    section: "triangle.md#do-not-flip-the-normal",
    questions: |rng| table_questions(rng, &["normal"], Side::Either),
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};

pub(super) const ORIGIN_AND_MATERIAL: Declaration = Declaration {
    id: "triangle.origin_and_material",
    title: "the trace holds the ray's origin and the triangle's shape",
    look: "Copy both: the origin from the ray, and the shape's number from the triangle.",
    section: "triangle.md#what-to-return",
    questions: |rng| {
        let mut table = |number: u32| {
            let vertices = random_triangle(rng);
            let mut rays: Vec<Ray> = (0..6)
                .map(|_| hitting_ray(rng, &vertices, Side::Front))
                .collect();
            rays.extend((0..3).map(|_| missing_ray(rng, &vertices, Side::Front)));
            let judged = ["origin", "shape"];
            shape_question(&judged, shape(&vertices, number), rays)
        };
        vec![table(0), table(7), table(42)]
    },
    ..Declaration::in_group(groups::TRIANGLE_SURFACE)
};
