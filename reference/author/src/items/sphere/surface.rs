//! What is told of the meeting.

use glam::{DVec3, Vec3, dvec3};
use grader::exam::{HitCheck, Item};
use protocol::{Ray, Shape};

use super::{
    hitting_ray, item, missing_ray, random_sphere, ray_from_inside, sphere_question,
    table_questions,
};
use crate::items::picture;
use crate::oracle::sphere::Sphere;
use crate::seed::{Rng, Seed};

fn hitting_ray_from_either_side(draw: &mut Rng, ball: &Sphere) -> Ray {
    if draw.coin() {
        hitting_ray(draw, ball)
    } else {
        ray_from_inside(draw, ball)
    }
}

pub(super) fn position(seed: Seed) -> Item {
    item(
        "position",
        1,
        [
            "position is the point of the meeting, in world space",
            "It is the ray's point at the distance t. A point relative to the centre still has the \
             centre to be added.",
        ],
        table_questions(
            "sphere.position",
            seed,
            &[HitCheck::Position],
            &[0.8, 2.0],
            hitting_ray_from_either_side,
        ),
    )
}

pub(super) fn normal(seed: Seed) -> Item {
    let judged = [HitCheck::Normal, HitCheck::UnitNormal];
    let outside = table_questions("sphere.normal", seed, &judged, &[0.5, 3.0], hitting_ray);
    let inside = table_questions(
        "sphere.normal.inside",
        seed,
        &judged,
        &[2.0],
        ray_from_inside,
    );
    item(
        "normal",
        1,
        [
            "the normal points away from the centre, with length one, also from inside",
            "From the centre to the meeting, divided by its length. It belongs to the surface, not \
             to the ray: it is never flipped toward it.",
        ],
        outside.into_iter().chain(inside).collect(),
    )
}

pub(super) fn uv(seed: Seed) -> Item {
    item(
        "uv",
        1,
        [
            "uv comes from the direction from the centre",
            "Sphere::uv is given: call it with the direction from the centre to the meeting, not \
             with the position or the ray's direction.",
        ],
        table_questions("sphere.uv", seed, &[HitCheck::Uv], &[1.0, 1.0], hitting_ray),
    )
}

pub(super) fn uv_radius(seed: Seed) -> Item {
    item(
        "uv_radius",
        1,
        [
            "uv does not depend on the radius",
            "Sphere::uv wants a direction of length one: from the centre to the meeting is a vector \
             as long as the radius.",
        ],
        table_questions(
            "sphere.uv_radius",
            seed,
            &[HitCheck::Uv],
            &[0.4, 2.5],
            hitting_ray_from_either_side,
        ),
    )
}

pub(super) fn origin_and_material(seed: Seed) -> Item {
    let mut draw = seed.rng("sphere.origin_and_material");
    let mut table = |material: u32| {
        let ball = random_sphere(&mut draw, 1.2);
        let mut rays: Vec<Ray> = (0..3).map(|_| hitting_ray(&mut draw, &ball)).collect();
        rays.extend((0..3).map(|_| ray_from_inside(&mut draw, &ball)));
        rays.extend((0..3).map(|_| missing_ray(&mut draw, &ball)));
        sphere_question(
            &[HitCheck::Origin, HitCheck::Material],
            &ball,
            material,
            rays,
        )
    };
    item(
        "origin_and_material",
        1,
        [
            "the answer names the ray's origin and the sphere's material",
            "Both are copied: origin from the ray that was asked, also if you moved it to the \
             sphere's centre for the sums; material from the sphere.",
        ],
        vec![table(0), table(3), table(99)],
    )
}

pub(super) fn picture(seed: Seed) -> Item {
    let mut draw = seed.rng("sphere.picture");
    let mut sphere = |x: f64, y: f64, z: f64, radius: f64| {
        let center = dvec3(x, y, z) + draw.point(0.1);
        Shape::Sphere {
            center: center.as_vec3(),
            radius: radius as f32,
            material: 0,
        }
    };
    let view = |half, pixels| picture::view_along(Vec3::ZERO, DVec3::NEG_Z, half, pixels);
    // No centre is so high or low that its sphere would show a pole.
    let from_outside = vec![
        sphere(0.2, 0.0, -5.0, 1.2),
        sphere(-1.6, 0.3, -4.0, 0.7),
        sphere(1.5, -0.2, -3.5, 0.5),
        sphere(-0.8, -0.3, -3.0, 0.45),
        sphere(2.6, 0.4, -7.0, 1.6),
    ];
    let from_inside = vec![sphere(0.0, 0.0, -0.5, 3.0), sphere(0.9, 0.1, -2.0, 0.4)];
    item(
        "picture",
        2,
        [
            "a picture of spheres is right in hit, depth, normal and uv",
            "Some seen from outside, and one from inside. If all pixels of one are wrong, see what \
             sets it apart: its radius, or where the camera is.",
        ],
        vec![
            picture::picture_question(view(0.6, 64), from_outside),
            picture::picture_question(view(0.6, 32), from_inside),
        ],
    )
}
