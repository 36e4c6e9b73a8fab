//! Items about the quantities of a hit.

use judging::exam::{HitCheck, Item};
use protocol::Ray;

use super::aim::{
    Side, hitting_ray, missing_ray, random_triangle, ray_through, shape, weights_inside,
};
use super::{item, table_questions};
use crate::items::shapes_question;
use crate::seed::Seed;

pub(super) fn position(seed: Seed) -> Item {
    item(
        "position",
        1,
        [
            "position is the point where the ray hits the triangle",
            "It is the ray's point at t, or the weighted sum of the corners: both are the same.",
        ],
        table_questions(
            "triangle.position",
            seed,
            &[HitCheck::Position],
            Side::Front,
        ),
    )
}

pub(super) fn normal(seed: Seed) -> Item {
    item(
        "normal",
        1,
        [
            "the normal is interpolated between the corners' normals",
            "Each corner has its own normal, for smooth shading, and the normal of the flat face \
             is not used. w goes with p0, u with p1 and v with p2.",
        ],
        table_questions("triangle.normal", seed, &[HitCheck::Normal], Side::Front),
    )
}

pub(super) fn uv(seed: Seed) -> Item {
    item(
        "uv",
        1,
        [
            "uv is interpolated between the corners' texture coordinates",
            "The barycentric u and v are weights; the uv of the Trace is the weighted sum of the \
             corners' uv.",
        ],
        table_questions("triangle.uv", seed, &[HitCheck::Uv], Side::Front),
    )
}

pub(super) fn uv_corners(seed: Seed) -> Item {
    let mut rng = seed.rng("triangle.uv_corners");
    let mut table = || {
        let vertices = random_triangle(&mut rng);
        let mut rays = Vec::new();
        for corner in 0..3 {
            for _ in 0..3 {
                let mut weights = weights_inside(&mut rng, 0.25).map(|w| 0.2 * w);
                weights[corner] += 0.8;
                rays.push(ray_through(&mut rng, &vertices, weights, Side::Front));
            }
            rays.push(missing_ray(&mut rng, &vertices, Side::Front));
        }
        shapes_question(&[HitCheck::Uv], vec![shape(&vertices, 0)], rays)
    };
    item(
        "uv_corners",
        1,
        [
            "near a corner, that corner's texture coordinates count most",
            "If two corners are swapped, so are two of the weights: w goes with p0, u with p1 and \
             v with p2.",
        ],
        vec![table(), table()],
    )
}

pub(super) fn normal_from_behind(seed: Seed) -> Item {
    item(
        "normal_from_behind",
        1,
        [
            "seen from behind, the normal stays as it is",
            "The normal belongs to the surface, not to the ray, so it is never flipped toward the \
             ray.",
        ],
        table_questions(
            "triangle.normal_from_behind",
            seed,
            &[HitCheck::Normal],
            Side::Either,
        ),
    )
}

pub(super) fn origin_and_material(seed: Seed) -> Item {
    let mut rng = seed.rng("triangle.origin_and_material");
    let mut table = |material: u32| {
        let vertices = random_triangle(&mut rng);
        let mut rays: Vec<Ray> = (0..6)
            .map(|_| hitting_ray(&mut rng, &vertices, Side::Front))
            .collect();
        rays.extend((0..3).map(|_| missing_ray(&mut rng, &vertices, Side::Front)));
        let checks = [HitCheck::Origin, HitCheck::Material];
        shapes_question(&checks, vec![shape(&vertices, material)], rays)
    };
    item(
        "origin_and_material",
        1,
        [
            "the trace holds the ray's origin and the triangle's material",
            "Copy both: the origin from the ray, and the material from the triangle.",
        ],
        vec![table(0), table(7), table(42)],
    )
}
