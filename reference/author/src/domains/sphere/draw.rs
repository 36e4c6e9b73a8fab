//! Generates random spheres, and rays that start in, around and beside them.

use std::f64::consts::TAU;

use glam::DVec3;
use protocol::{Interval, Ray, Shape};

use super::line::Line;
use super::{NEAR, RAY_ASPECTS, SUBJECT_ASPECTS};
use crate::domains::fields;
use crate::domains::shape::{FOLLOW, ShapeCall};
use crate::domains::{Call, Change, Generator};
use crate::oracle::scan;
use crate::seed::Rng;

/// Generates random spheres of these sizes and, for each sphere, random rays for which `belongs`
/// returns true. Half of the rays hit their sphere. Every correct formula computes the judged
/// quantities within their tolerances.
pub fn tables(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Line) -> bool,
) -> Vec<(Shape, Vec<Ray>)> {
    let is_fair = |line: &Line| line.is_clear() && judged.iter().all(|it| line.is_exact(it));
    let generator = Generator {
        subject_aspects: SUBJECT_ASPECTS,
        call_aspects: RAY_ASPECTS,
        subject: &drawn_shape,
        input: &ray,
        changes: CHANGES,
        // Items about a single quantity stay short.
        most_changes: if judged.len() > 2 { CHANGES.len() } else { 1 },
        follow: FOLLOW,
        fits: &|call| Line::of(call).is_some_and(|line| is_fair(&line) && belongs(&line)),
        differ: &|one, other| one.differs(other, judged),
    };
    generator.tables(rng, sizes)
}

/// Picks a random sphere with a radius in this class.
fn drawn_shape(rng: &mut Rng, size: usize) -> Shape {
    // Some radii are common numbers, such as 0.5, 1.5 or 12.
    let common = match size {
        4 => Some(0.125 * f64::from(rng.integer(1, 7))),
        5 => Some(0.5 * f64::from(rng.integer(2, 19))),
        6 => Some(4.0 * f64::from(rng.integer(3, 24))),
        _ => None,
    };
    let common = common.filter(|_| rng.index(4) == 0);
    let size = common.unwrap_or_else(|| fields::size(rng, size));
    let radius = size as f32;
    let mut center = fields::place(rng, size).as_vec3();
    let axis = rng.index(3);
    match rng.index(8) {
        // The highest point is level with the origin, as it is when a sphere serves as the ground.
        0 => center.y = -radius,
        1 if radius >= 100.0 => center.y = -radius,
        1 => center[axis] = radius * rng.sign() as f32,
        _ => {}
    }
    Shape::Sphere {
        center,
        radius,
        shape: fields::number(rng),
    }
}

/// Picks a random ray that starts in, around or beside a sphere. Returns `None` if it would start
/// too far away.
fn ray(rng: &mut Rng, shape: &Shape) -> Option<Ray> {
    let bounds = scan::bounds(shape);
    let (center, radius) = (bounds.center(), 0.5 * (bounds.max - bounds.min).x);
    let dir = match rng.index(8) {
        0 => fields::diagonal(rng),
        _ => fields::direction(rng),
    };
    let approach = match rng.index(6) {
        0 => 0.0,
        1 | 2 => rng.uniform(0.0, 0.9),
        3 => rng.uniform(0.9, 0.995),
        4 => rng.uniform(1.005, 1.15),
        _ => rng.uniform(1.15, 3.0),
    };
    let half_chord = radius * (1.0 - approach * approach).max(0.0).sqrt();
    let beside = radius * rng.log_uniform(0.012, NEAR);
    let ahead = match rng.index(9) {
        0 => radius * rng.uniform(1.2, 10.0),
        1 => radius * rng.uniform(10.0, 29.0),
        2 => half_chord * rng.uniform(-0.9, 0.9),
        3 => 0.0,
        4 => half_chord * rng.sign(),
        5 => half_chord + beside,
        6 => (half_chord - beside) * rng.sign(),
        7 => radius * rng.log_uniform(1e-4, 0.04) * rng.sign(),
        _ => -radius * rng.log_uniform(1.2, 29.0),
    };
    let target = if rng.index(8) > 0 {
        center + approach * radius * rng.perpendicular_to(dir)
    } else {
        // Near a pole.
        let from_pole = rng.log_uniform(0.012, NEAR);
        let height = rng.sign() * (1.0 - from_pole * from_pole).sqrt();
        let turn = rng.uniform(0.0, TAU);
        let pole = DVec3::new(from_pole * turn.cos(), height, from_pole * turn.sin());
        center + radius * pole
    };
    let (origin, dir) = fields::ray_toward(rng, target, dir, ahead, radius)?;
    let ray = Ray::new(origin.as_vec3(), dir.as_vec3());
    let range = match rng.index(8) {
        0 => range_from_a_root(rng, &Line::of(&ShapeCall::new(*shape, ray))?)?,
        _ => fields::range(rng, ahead.max(0.0) + 2.0 * radius),
    };
    Some(ray.within(range.min, range.max))
}

/// Picks a random range that begins or ends just before or just after a root.
fn range_from_a_root(rng: &mut Rng, line: &Line) -> Option<Interval> {
    let beside = line.sphere.radius * rng.log_uniform(0.0101, 0.02);
    let end = line.roots[rng.index(2)] + rng.sign() * beside;
    fields::range_with_end(rng, end)
}

/// The ways a sphere can differ from the previous one.
const CHANGES: &[Change<ShapeCall>] = &[
    ShapeCall::smaller,
    ShapeCall::slightly_larger,
    |call, random| call.elsewhere_along(0, random),
    |call, random| call.elsewhere_along(1, random),
    |call, random| call.elsewhere_along(2, random),
    ShapeCall::with_other_number,
    ShapeCall::in_a_smaller_world,
    |call, _| {
        let center = scan::bounds(&call.shape).center();
        call.moved_to_origin(center.as_vec3())
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    /// Evaluates the full quadratic formula in single precision.
    fn distance(ray: &Ray, shape: &Shape) -> Option<f32> {
        let Shape::Sphere { center, radius, .. } = *shape else {
            return None;
        };
        let from_center = ray.origin - center;
        let (a, b) = (ray.dir.dot(ray.dir), 2.0 * ray.dir.dot(from_center));
        let discriminant = b * b - 4.0 * a * (from_center.dot(from_center) - radius * radius);
        let root = |sign: f32| (-b + sign * discriminant.sqrt()) / (2.0 * a);
        [root(-1.0), root(1.0)]
            .into_iter()
            .find(|&t| ray.range.contains(t))
    }

    #[test]
    fn a_usual_formula_in_single_precision_stays_within_the_tolerances() {
        for seed in 0..8 {
            let mut rng = Seed(seed).rng("sphere");
            for (shape, rays) in tables(&mut rng, &["distance"], fields::EVERY_SIZE, |_| true) {
                for ray in rays {
                    let line = Line::of(&ShapeCall::new(shape, ray)).expect("a sphere");
                    let (got, expected) = (distance(&ray, &shape), line.hits().next());
                    assert_eq!(got.is_some(), expected.is_some(), "{ray:?} {shape:?}");
                    let error = f64::from(got.unwrap_or(0.0)) - expected.unwrap_or(0.0);
                    assert!(
                        error.abs() < 0.5e-4 * line.coordinates(),
                        "{ray:?} {shape:?}"
                    );
                }
            }
        }
    }
}
