//! The domain of `Sphere::hit`.

mod draw;
mod line;

use glam::Vec3;
use protocol::Shape;

use super::fields::class_below;
use super::shape::{
    self, DISTANCE, HARDLY_MOVED, HARDLY_TURNED, HISTORY, MIRRORED_START, NUMBER, ORIGIN, ShapeCall,
};
use super::{Aspect, FunctionDomain, not_asked};

pub use draw::tables;
pub use line::Line;

/// The domain of `Sphere::hit`.
pub static SPHERE: FunctionDomain<ShapeCall> = FunctionDomain {
    aspects: &[SUBJECT_ASPECTS, RAY_ASPECTS],
    pairs: &[["size", "direction"], ["size", "start"]],
    not_asked: &[
        not_asked(&["call before"])
            .classes(&[HARDLY_TURNED, HARDLY_MOVED])
            .columns(&["`None`", "normal", "unit_normal", "origin", "shape", "uv"])
            .because(
                "A change this small has a noticeable effect only on the distance and the \
                 position.",
            ),
        not_asked(&["distance"])
            .columns(&["`None`"])
            .because("A miss has no distance."),
        not_asked(&["latitude"])
            .columns(&["`None`"])
            .because("A miss has no latitude."),
        not_asked(&["call before"])
            .classes(&[
                "the same ray with its axes in another order",
                MIRRORED_START,
            ])
            .columns(&["normal", "unit_normal", "origin", "position", "shape", "uv"])
            .because(
                "A ray like this hits only shapes near the origin, so it is enough if an exam \
                 tests the distance to the hit.",
            ),
        not_asked(&["centre"])
            .columns(&["normal", "unit_normal", "origin", "position", "shape", "uv"])
            .because(
                "Rays hit a sphere on an axis in the same way as any other sphere. To check \
                 this, it is enough if an exam tests the distance.",
            ),
        not_asked(&["place"])
            .classes(&["1,000 sizes away"])
            .columns(&["normal", "unit_normal", "uv"])
            .because(
                "At this distance from the origin, rounding the centre's coordinates changes \
                 the normal by more than the tolerance for normals.",
            ),
        not_asked(&["start"])
            .classes(&["behind"])
            .because("A sphere behind the start of the ray is not hit."),
        not_asked(&["line"])
            .classes(&["grazing, outside", "outside"])
            .because("A ray whose line misses the sphere hits nothing."),
        not_asked(&["size"])
            .classes(&["500"])
            .columns(&["pairs"])
            .because(
                "In a scene whose coordinates only go up to 1,000, nothing is 30 radii away \
                 from a sphere of this size.",
            ),
        not_asked(&["distance"])
            .classes(&["2000", "3000"])
            .columns(&["normal", "unit_normal", "origin", "position", "shape", "uv"])
            .because(
                "Only the largest spheres are hit from so far away, so it is enough if an exam \
                 tests the distance to the hit.",
            ),
    ],
    ..FunctionDomain::new("Sphere::hit", shape::calls)
};

/// The aspects of spheres.
const SUBJECT_ASPECTS: &[Aspect<ShapeCall>] = &[
    Aspect::SIZE,
    Aspect::ROUND,
    // Radii that are exactly a power of ten, and the largest radii.
    Aspect::new(
        "radius",
        &[
            "exactly 1",
            "exactly 10 or 100",
            "exactly 0.1 or less",
            "900 to 1000",
        ],
        |call| {
            let Shape::Sphere { radius, .. } = call.shape else {
                return None;
            };
            let exact = [1.0, 10.0, 100.0, 0.1, 0.01, 1e-3];
            match exact.iter().position(|it| *it == radius) {
                Some(index) => Some(usize::from(index > 0) + usize::from(index > 2)),
                None => (radius >= 900.0).then_some(3),
            }
        },
    ),
    // Spheres whose centre is on an axis, but not at the origin.
    Aspect::new(
        "centre",
        &["straight ahead of a camera", "on another axis"],
        |call| {
            let Shape::Sphere { center, .. } = call.shape else {
                return None;
            };
            let zeros = center.cmpeq(Vec3::ZERO).bitmask().count_ones();
            (zeros == 2).then_some(usize::from(center.z >= 0.0))
        },
    ),
    Aspect::PLACE,
    Aspect::OCTANT,
    // Spheres that touch a coordinate plane.
    Aspect::new(
        "touches",
        &[
            "the plane y = 0 from below, like the ground",
            "the plane y = 0 from below, with a radius below 100",
            "another plane",
            "nothing",
        ],
        |call| {
            let Shape::Sphere { center, radius, .. } = call.shape else {
                return None;
            };
            let touches = center.to_array().iter().any(|it| it.abs() == radius);
            Some(match (center.y == -radius, touches) {
                (true, _) => usize::from(radius < 100.0),
                (false, true) => 2,
                (false, false) => 3,
            })
        },
    ),
    NUMBER,
];

/// The aspects of rays and of the points where their lines cross the sphere.
const RAY_ASPECTS: &[Aspect<ShapeCall>] = &[
    // The start of the ray relative to the sphere.
    Aspect::new(
        "start",
        &[
            "in front, up to 10 radii away",
            "in front, up to 30 radii away",
            "inside",
            "at the centre",
            "on the surface",
            "behind",
            "just in front",
            "just inside",
            "almost at the centre",
        ],
        |call| {
            let line = Line::of(call)?;
            let Line { sphere, ray64, .. } = line;
            let leads_away = ray64.dir.dot(sphere.center - ray64.origin) < 0.0;
            let is_near = line
                .roots
                .into_iter()
                .any(|root| root > 0.0 && root < NEAR * sphere.radius);
            Some(match line.start() {
                ..1e-6 => 3,
                ..0.05 => 8,
                0.999..1.001 => 4,
                ..1.0 if is_near => 7,
                ..1.0 => 2,
                _ if leads_away => 5,
                _ if is_near => 6,
                ..10.0 => 0,
                _ => 1,
            })
        },
    ),
    ORIGIN,
    DISTANCE,
    // The distance of the ray's line from the centre.
    Aspect::new(
        "line",
        &[
            "through the centre",
            "inside",
            "grazing, inside",
            "grazing, outside",
            "outside",
        ],
        |call| {
            Some(class_below(
                &[1e-3, 0.9, 1.0, 1.15],
                Line::of(call)?.approach,
            ))
        },
    ),
    // The distance of the hit from the axis through the poles.
    Aspect::new("latitude", &["near a pole", "anywhere"], |call| {
        let line = Line::of(call)?;
        Some(usize::from(line.pole_distance(line.hits().next()?) > NEAR))
    }),
    Aspect::DIRECTION,
    Aspect::DIAGONAL,
    Aspect::RANGE,
    // The ends of the range relative to the roots.
    Aspect::new(
        "end of the range",
        &[
            "just before or behind a root",
            "just before or behind a distant root",
            "anywhere",
        ],
        |call| {
            let line = Line::of(call)?;
            let ends = [line.ray64.min, line.ray64.max];
            let mut roots = line.roots.into_iter();
            let near = roots.find(|root| {
                let mut beside = ends.iter().map(|end| (root - end).abs());
                beside.any(|it| it < 0.02 * line.sphere.radius)
            });
            Some(match near {
                Some(root) if root > DISTANT * line.sphere.radius => 1,
                Some(_) => 0,
                None => 2,
            })
        },
    ),
    HISTORY,
];

/// The minimum distance at which a root counts as distant, in radii.
const DISTANT: f64 = 15.0;

/// The maximum distance at which a root counts as near, in radii.
const NEAR: f64 = 0.1;
