//! Items about the values that are returned for a hit, and the item with a picture of spheres.

use glam::{DVec3, Vec3, dvec3};
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;

use super::questions;
use crate::domains::fields::{EVERY_SIZE, USUAL};
use crate::items::{Declaration, groups, meshes, picture};
use crate::seed::Rng;

pub(super) const POSITION: Declaration = Declaration {
    id: "sphere.position",
    title: "the position is the point where the ray hits the sphere, in world space",
    look: "The position is ray.origin + t · ray.dir, with the t that you return as the distance. \
        This point is in world space, and its distance from the centre is the radius.",
    look_fits: &[Symptom::of("position")],
    section: "sphere.md#what-to-return",
    tests: &["`distance` is the…"],
    questions: |rng| questions(rng, &["position"], EVERY_SIZE, |_| true),
    ..Declaration::in_group(groups::SPHERE_SURFACE)
};

pub(super) const NORMAL: Declaration = Declaration {
    id: "sphere.normal",
    title: "the normal points away from the centre and has length one, even from inside",
    look: "Divide the vector from the centre to the hit by its length. The normal belongs to the \
           surface, so it is never flipped toward the ray.",
    look_fits: &[Symptom::of("normal"), Symptom::of("length of the normal")],
    section: "sphere.md#the-normal-points-away-from-the-centre",
    tests: &["`normal` has length…"],
    questions: |rng| questions(rng, &["normal", "unit_normal"], EVERY_SIZE, |_| true),
    ..Declaration::in_group(groups::SPHERE_SURFACE)
};

pub(super) const UV: Declaration = Declaration {
    id: "sphere.uv",
    title: "uv is computed from the direction from the centre to the hit",
    look: "The uv comes from the given Sphere::uv, which needs the unit-length direction from the \
           centre to the hit. Check the vector that you pass: where does it start, which way does \
           it point, and how long is it?",
    look_fits: &[Symptom::of("uv")],
    section: "sphere.md#the-uv-function-needs-a-unit-direction",
    tests: &["`uv` is computed…"],
    questions: |rng| {
        questions(rng, &["uv"], USUAL, |line| {
            line.misses() || line.roots[0] > 0.0
        })
    },
    ..Declaration::in_group(groups::SPHERE_SURFACE)
};

pub(super) const UV_RADIUS: Declaration = Declaration {
    id: "sphere.uv_radius",
    title: "uv does not depend on the radius",
    look: "Sphere::uv needs the direction from the centre to the hit, with length one: is your vector \
           as long as the radius, or does it point the other way?",
    look_fits: &[Symptom::of("uv")],
    section: "sphere.md#the-uv-function-needs-a-unit-direction",
    tests: &["`uv` is computed…"],
    questions: |rng| questions(rng, &["uv"], EVERY_SIZE, |_| true),
    ..Declaration::in_group(groups::SPHERE_SURFACE)
};

pub(super) const ORIGIN_AND_MATERIAL: Declaration = Declaration {
    id: "sphere.origin_and_material",
    title: "the trace contains the ray's origin and the sphere's shape",
    look: "Copy both: the origin from the given ray, even if you used a shifted one in your calculation, \
        and the shape's number from the sphere.",
    look_fits: &[Symptom::of("origin"), Symptom::of("shape")],
    section: "sphere.md#what-to-return",
    tests: &["`distance` is the…"],
    questions: |rng| questions(rng, &["origin", "shape"], EVERY_SIZE, |_| true),
    ..Declaration::in_group(groups::SPHERE_SURFACE)
};

pub(super) const PICTURE: Declaration = Declaration {
    id: "sphere.picture",
    points: 2,
    title: "a picture of spheres has the correct hits, depth, normals and uv",
    look: "Some spheres are seen from outside, and one from inside. If one sphere is wrong all \
           over, how does it differ from the others: does it have a different radius or centre, or is the \
           camera inside it?",
    section: "grading.md#reading-a-wrong-picture",
    tests: &["Returns the ray's…"],
    questions: picture,
    ..Declaration::ALONE
};

fn picture(rng: &mut Rng) -> Vec<ExamQuestion> {
    let side = rng.sign();
    let mut sphere = |x: f64, y: f64, z: f64, radius: f64| {
        let center = dvec3(side * x, y, z) + rng.point(0.3) * dvec3(1.0, 0.3, 1.0);
        meshes::sphere(center, radius * rng.uniform(0.9, 1.1))
    };
    let camera = |half, pixels| picture::camera_along(Vec3::ZERO, DVec3::NEG_Z, half, pixels);
    // All spheres are roughly level with the camera, so that no pole is visible.
    let from_outside = vec![
        sphere(0.2, 0.0, -5.0, 1.2),
        sphere(-1.6, 0.3, -4.0, 0.7),
        sphere(1.5, -0.2, -3.5, 0.5),
        sphere(-0.8, -0.3, -3.0, 0.45),
        sphere(2.6, 0.4, -7.0, 1.6),
    ];
    let from_inside = vec![sphere(0.0, 0.0, -0.5, 3.0), sphere(0.9, 0.1, -2.0, 0.4)];
    vec![
        picture::picture_question(camera(0.6, 64), from_outside),
        picture::picture_question(camera(0.6, 32), from_inside),
    ]
}
