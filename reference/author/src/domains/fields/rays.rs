//! Rays toward a target, and rays that are almost the same as another ray or mirror images of it.

use glam::{DVec3, Vec3};
use protocol::Ray;

use super::FURTHEST;
use crate::seed::Rng;

/// Returns the start and the direction of a ray toward a target. Most rays start at this distance
/// from the target, but some start far away or at the origin. Returns `None` if the ray would start
/// outside the scene.
pub fn ray_toward(
    rng: &mut Rng,
    target: DVec3,
    dir: DVec3,
    ahead: f64,
    size: f64,
) -> Option<(DVec3, DVec3)> {
    let from = |start: DVec3| (start, (target - start).normalize());
    let (start, dir) = match rng.index(16) {
        0 | 1 => from(start_far_away(rng, target, size)?),
        2 if (1e-3 * size..29.0 * size).contains(&target.length()) => from(DVec3::ZERO),
        3 => from(start_on_an_axis(rng, target, size)?),
        _ => (target - ahead * dir, dir),
    };
    (start.abs().max_element() <= FURTHEST).then_some((start, dir))
}

/// Picks a random start for a ray toward a target. The start is far from the origin, but less than
/// 29 times `size` away from the target.
fn start_far_away(rng: &mut Rng, target: DVec3, size: f64) -> Option<DVec3> {
    let least = if rng.coin() { 0.5 } else { 0.98 };
    let start = rng.vector(least, 1.0) * FURTHEST * -target.signum();
    (start.distance(target) < 29.0 * size).then_some(start)
}

/// The largest angle, in radians, between two directions that count as hardly different. Also the
/// largest distance between two starts that count as hardly different, as a multiple of the size of
/// the rays' target.
pub const HARDLY: f64 = 4e-4;

/// Returns the ray with its direction turned by this angle, in radians.
pub fn turned(rng: &mut Rng, ray: &Ray, angle: f64) -> Ray {
    let dir = ray.dir.as_dvec3();
    let dir = (dir + angle * rng.perpendicular_to(dir)).normalize();
    let dir = dir.as_vec3();
    Ray { dir, ..*ray }
}

/// Returns the ray with its start moved by this distance.
pub fn moved(rng: &mut Rng, ray: &Ray, distance: f64) -> Ray {
    let origin = ray.origin + (distance * rng.direction()).as_vec3();
    Ray { origin, ..*ray }
}

/// Returns the ray with one or two components of its direction negated. Returns `None` if that
/// leaves the direction unchanged or reverses it completely.
pub fn mirrored(rng: &mut Rng, ray: &Ray) -> Option<Ray> {
    let dir = with_signs_changed(rng, ray.dir);
    (dir != ray.dir && dir != -ray.dir).then_some(Ray { dir, ..*ray })
}

/// Returns the ray with one or two coordinates of its start negated. Returns `None` if that doesn't
/// change the ray.
pub fn mirrored_start(rng: &mut Rng, ray: &Ray) -> Option<Ray> {
    let origin = with_signs_changed(rng, ray.origin);
    (origin != ray.origin).then_some(Ray { origin, ..*ray })
}

/// Negates one or two components.
fn with_signs_changed(rng: &mut Rng, mut vector: Vec3) -> Vec3 {
    let axis = rng.index(3);
    vector[axis] = -vector[axis];
    if rng.coin() {
        vector[(axis + 1) % 3] = -vector[(axis + 1) % 3];
    }
    vector
}

/// Returns whether two rays differ only in the signs of their directions' components.
pub fn is_mirrored(a: &Ray, b: &Ray) -> bool {
    a.origin == b.origin && a.range == b.range && a.dir != b.dir && a.dir.abs() == b.dir.abs()
}

/// Returns whether two rays differ only in the signs of their starts' coordinates.
pub fn is_mirrored_start(a: &Ray, b: &Ray) -> bool {
    let same_sizes = a.origin.abs() == b.origin.abs();
    same_sizes && a.range == b.range && a.dir == b.dir && a.origin != b.origin
}

/// Picks a random start for a ray toward a target. The start is on an axis or in a plane between
/// two axes, but not at the origin, and at most 29 times `size` away from the target.
fn start_on_an_axis(rng: &mut Rng, target: DVec3, size: f64) -> Option<DVec3> {
    let mut start = target + size * rng.uniform(1.0, 20.0) * rng.direction();
    let axis = rng.index(3);
    start[axis] = 0.0;
    if rng.coin() {
        start[(axis + 1) % 3] = 0.0;
    }
    (start.distance(target) < 29.0 * size).then_some(start)
}

/// Returns whether two rays differ only in their ranges.
pub fn is_same_line(a: &Ray, b: &Ray) -> bool {
    a.origin == b.origin && a.dir == b.dir
}

/// Returns whether two rays are different but each of their numbers differs by at most a
/// five-thousandth of its value.
pub fn is_almost_the_same_ray(a: &Ray, b: &Ray) -> bool {
    const MOST: f32 = 2e-4;
    let is_near = |a: Vec3, b: Vec3| (a - b).abs().cmple(MOST * a.abs()).all();
    !is_same_line(a, b)
        && a.range == b.range
        && is_near(a.origin, b.origin)
        && is_near(a.dir, b.dir)
}

/// Returns the ray with one coordinate of the start or one component of the direction changed by at
/// most a ten-thousandth of its value.
pub fn almost_the_same_ray(rng: &mut Rng, ray: &Ray) -> Ray {
    const MOST: f64 = 1e-4;
    let (axis, nudge) = (rng.index(3), 1.0 + rng.uniform(-MOST, MOST));
    let (mut origin, mut dir) = (ray.origin, ray.dir.as_dvec3());
    if rng.coin() {
        origin[axis] = (f64::from(origin[axis]) * nudge) as f32;
    } else {
        dir[axis] *= nudge;
    }
    Ray {
        origin,
        dir: dir.normalize().as_vec3(),
        ..*ray
    }
}

/// Returns the class of the previous call: none, a different ray, or the same ray.
pub fn history_class(before: Option<&Ray>, ray: &Ray) -> usize {
    before.map_or(0, |before| 1 + usize::from(is_same_line(before, ray)))
}
