//! Calls that are almost identical to the previous call on the same shape.

use glam::Vec3Swizzles;
use protocol::Ray;

use super::ShapeCall;
use crate::domains::Call;
use crate::domains::fields::{
    HARDLY, is_mirrored, is_mirrored_start, mirrored, mirrored_start, moved, turned,
};
use crate::domains::tables::Follow;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// The largest angle, in radians, between two directions that count as almost the same.
const ANGLE: f64 = 2e-3;

/// The largest distance between the origins of two rays that count as almost the same, as a
/// multiple of the shape's size.
const DISTANCE: f64 = 0.02;

/// The largest difference between the ends of two ranges that count as almost the same, as a
/// multiple of the shape's size.
const ENDS: f64 = 0.03;

/// The ways a call can follow another.
pub const FOLLOW: &[Follow<ShapeCall>] = &[
    |rng, before| {
        let angle = rng.log_uniform(0.2, 0.95) * ANGLE;
        Some(vec![before.with_ray(turned(rng, &before.ray, angle))])
    },
    |rng, before| {
        let angle = rng.uniform(0.7, 0.97) * HARDLY;
        Some(vec![before.with_ray(turned(rng, &before.ray, angle))])
    },
    |rng, before| {
        let distance = rng.log_uniform(0.1, 0.95) * DISTANCE * before.size();
        Some(vec![before.with_ray(moved(rng, &before.ray, distance))])
    },
    |rng, before| {
        let distance = rng.uniform(0.7, 0.97) * HARDLY * before.size();
        Some(vec![before.with_ray(moved(rng, &before.ray, distance))])
    },
    with_ranges_beside_a_hit,
    |_, before| {
        let dir = -before.ray.dir;
        Some(vec![before.with_ray(Ray { dir, ..before.ray })])
    },
    |rng, before| Some(vec![before.with_ray(mirrored(rng, &before.ray)?)]),
    |rng, before| Some(vec![before.with_ray(mirrored_start(rng, &before.ray)?)]),
    |rng, before| {
        let Ray { origin, dir, .. } = before.ray;
        let (origin, dir) = if rng.coin() {
            (origin.yzx(), dir.yzx())
        } else {
            (origin.zxy(), dir.zxy())
        };
        let ray = Ray {
            origin,
            dir,
            ..before.ray
        };
        Some(vec![before.with_ray(ray)])
    },
    |rng, before| {
        let beside = rng.uniform(0.51, 0.9) * DISTANCE * before.size() * rng.sign();
        let distance = (before.hit()?.distance + beside) as f32;
        let origin = before.ray.at(distance);
        Some(vec![before.with_ray(Ray {
            origin,
            ..before.ray
        })])
    },
];

/// Returns two calls whose rays differ only in their ranges. One range ends or begins just before a
/// hit, and the other ends or begins just after it. The two calls can come in either order.
fn with_ranges_beside_a_hit(rng: &mut Rng, before: &ShapeCall) -> Option<Vec<ShapeCall>> {
    let whole = before.ray.within(0.0, f32::INFINITY);
    let distance = scan::intersect(&Ray64::from(&whole), &before.shape)?.distance;
    let range = before.ray.range;
    let begins = range.min > 0.0 && rng.coin();
    let side = rng.sign();
    let ends = [side, -side].map(|side| {
        let beside = side * rng.uniform(0.34, 0.48) * ENDS * before.size();
        let end = (distance + beside) as f32;
        let ray = if begins {
            before.ray.within(end, range.max)
        } else {
            before.ray.within(range.min, end)
        };
        (end >= 0.0 && ray.range.min <= ray.range.max).then(|| before.with_ray(ray))
    });
    let [first, second] = ends;
    Some(vec![first?, second?])
}

/// Returns the class of the previous call: none, a different ray, or almost the same call.
pub fn class_of(call: &ShapeCall) -> usize {
    let Some(before) = call.before else {
        return 0;
    };
    let (ray, size) = (call.ray, call.size());
    let is_almost = |a: f32, b: f32| a == b || f64::from((a - b).abs()) < ENDS * size;
    let (same_start, same_dir) = (before.origin == ray.origin, before.dir == ray.dir);
    let same_range = before.range == ray.range;
    let between = ray.origin.as_dvec3().distance(before.origin.as_dvec3());
    let is_almost_the_same_range =
        || is_almost(before.range.min, ray.range.min) && is_almost(before.range.max, ray.range.max);
    let angle = before.dir.as_dvec3().distance(ray.dir.as_dvec3());
    let is_in_other_order = || {
        let orders = [
            (before.origin.yzx(), before.dir.yzx()),
            (before.origin.zxy(), before.dir.zxy()),
        ];
        orders.contains(&(ray.origin, ray.dir))
    };
    let starts_at_the_hit = || {
        let hit = ShapeCall::new(call.shape, before).hit();
        hit.is_some_and(|hit| hit.position.distance(ray.origin.as_dvec3()) < DISTANCE * size)
    };
    match (same_start, same_dir) {
        (true, true) if !same_range && is_almost_the_same_range() => 3,
        (true, true) => 2,
        (true, _) if same_range && before.dir == -ray.dir => 6,
        _ if is_mirrored(&before, &ray) => 9,
        _ if is_mirrored_start(&before, &ray) => 12,
        (true, _) if same_range && angle < HARDLY => 10,
        (_, true) if same_range && between < HARDLY * size => 11,
        (true, _) if same_range && angle < ANGLE => 4,
        (_, true) if same_range && between < DISTANCE * size => 5,
        _ if same_range && is_in_other_order() => 7,
        _ if starts_at_the_hit() => 8,
        _ => 1,
    }
}

impl ShapeCall {
    /// Returns the call on the same shape with a different ray.
    fn with_ray(&self, ray: Ray) -> Self {
        ShapeCall::new(self.shape, ray)
    }
}
