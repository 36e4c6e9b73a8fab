//! Picks random rays through and past a box, and times.

use glam::DVec3;
use protocol::{Interval, Ray};

use super::aspects::{CORNER, DISTANT, FOIL};
use super::call::{BoxCall, SMALL_COMPONENT};
use crate::domains::{Call, fields};
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Picks random times, and a random ray that passes through or beside a box. Returns `None` if the
/// ray would start too far away.
pub(super) fn query(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let size = bounds.half_side();
    let sides = bounds.max - bounds.min;
    let foil = (0..3).find(|&axis| 0.0 < sides[axis] && sides[axis] < 2.0 * FOIL * size);
    if let Some(axis) = foil.filter(|_| rng.coin()) {
        return slanted_across_foil(rng, bounds, axis);
    }
    if sides.min_element() == 0.0 && rng.index(6) == 0 {
        return past_a_corner(rng, bounds);
    }
    let dir = match rng.index(30) {
        0 | 1 => fields::diagonal(rng),
        2 | 3 => return slanted(rng, bounds),
        4 | 5 => return from_faces(rng, bounds),
        6 => return from_center(rng, bounds),
        7 => return from_a_plane_of_axes(rng, bounds),
        8 | 9 => return past_a_corner(rng, bounds),
        10..=16 => return from_the_origin(rng, bounds),
        _ => fields::direction(rng),
    };
    let (ray, times) = query_along(rng, bounds, dir)?;
    let is_short = rng.index(4) == 0;
    let short = is_short.then(|| short_times(rng, &BoxCall::new(*bounds, (ray, times))));
    Some((ray, short.flatten().unwrap_or(times)))
}

/// Picks random times that end just after the ray enters the box, or begin just before it leaves.
/// Returns `None` if the box isn't far ahead.
fn short_times(rng: &mut Rng, call: &BoxCall) -> Option<Interval> {
    let (enter, leave) = call.crossing()?;
    let inside = call.size() * rng.uniform(0.04, 0.07);
    if enter < DISTANT * call.size() {
        return None;
    }
    Some(if rng.coin() {
        Interval::new(
            rng.uniform(0.0, 0.9 * enter) as f32,
            (enter + inside) as f32,
        )
    } else {
        let end = leave * rng.uniform(1.1, 2.0);
        Interval::new((leave - inside) as f32, end as f32)
    })
}

/// Picks a random ray, usually in this direction. Some rays start far away or at the origin
/// instead, so their direction is different.
pub(super) fn query_along(rng: &mut Rng, bounds: &Bounds, dir: DVec3) -> Option<(Ray, Interval)> {
    let size = bounds.half_side();
    let target = target(rng, bounds);
    let ahead = size
        * match rng.index(6) {
            0 | 1 => rng.uniform(1.0, 3.0),
            2 | 3 => rng.uniform(3.0, 28.0),
            4 => rng.uniform(-0.5, 0.5),
            _ => -rng.uniform(2.0, 28.0),
        };
    let (origin, dir) = fields::ray_toward(rng, target, dir, ahead, size)?;
    Some(with_times(rng, origin, dir, ahead.max(0.0) + 2.0 * size))
}

/// Picks a random point in the box, close to one of its faces, or in the space around the box.
fn target(rng: &mut Rng, bounds: &Bounds) -> DVec3 {
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    match rng.index(4) {
        0 => bounds.center() + size * rng.point(2.0),
        1 => {
            // The target is close to a face, inside or outside the box. Its distance from the face
            // is a fraction of the box's size or of the side along this axis.
            let thinnest = (0..3).filter(|&axis| sides[axis] > 0.0);
            let thinnest = thinnest.min_by(|&a, &b| sides[a].total_cmp(&sides[b]));
            let axis = match thinnest {
                Some(axis) if rng.coin() => axis,
                _ => rng.index(3),
            };
            let mut target = bounds.center() + 0.45 * rng.point(1.0) * sides;
            let away = if rng.coin() {
                size * rng.uniform(0.03, 0.15)
            } else {
                sides[axis] * rng.uniform(0.13, 0.4)
            };
            let half = 0.5 * sides[axis] + rng.sign() * away;
            target[axis] = bounds.center()[axis] + rng.sign() * half;
            target
        }
        _ => bounds.center() + 0.45 * rng.point(1.0) * sides,
    }
}

/// Picks a random ray that is almost parallel to a slab, since one component of its direction is
/// almost 0. The box is so far away that the ray may enter or leave the slab before it gets there.
fn slanted(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    let axis = rng.index(3);
    let mut dir = DVec3::ZERO;
    dir[(axis + 1 + rng.index(2)) % 3] = rng.sign();
    dir[axis] = rng.sign() * rng.uniform(0.5, 0.95) * f64::from(SMALL_COMPONENT);
    let ahead = size * rng.uniform(15.0, 28.0);
    let mut target = bounds.center() + 0.4 * rng.point(1.0) * sides;
    target[axis] = bounds.center()[axis] + rng.uniform(-0.7, 0.7) * sides[axis];
    let origin = target - ahead * dir;
    with_times_in_scene(rng, origin, dir, ahead + 2.0 * size)
}

/// Picks a random ray that crosses a box as thin as foil or misses it. One component of its
/// direction is below 3e-6.
fn slanted_across_foil(rng: &mut Rng, bounds: &Bounds, axis: usize) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    let side = rng.sign();
    let (inward, inside) = if rng.coin() {
        (-side, -1.0)
    } else {
        (side, 1.0)
    };
    let mut dir = DVec3::ZERO;
    dir[(axis + 1 + rng.index(2)) % 3] = rng.sign();
    dir[axis] = inward * rng.uniform(1.5e-6, 2.9e-6);
    let mut target = bounds.center() + 0.4 * rng.point(1.0) * sides;
    let from_center = 0.5 + inside * rng.uniform(0.11, 0.3);
    target[axis] = bounds.center()[axis] + side * from_center * sides[axis];
    let ahead = size * rng.uniform(24.0, 28.0);
    let origin = target - ahead * dir;
    with_times_in_scene(rng, origin, dir, ahead + 2.0 * size)
}

/// Picks a random ray that starts exactly on a face of the box, on an edge, or at a corner.
fn from_faces(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let mut origin = bounds.center() + 0.4 * rng.point(1.0) * sides;
    let mut dir = fields::direction(rng);
    let (first, faces) = (rng.index(3), 1 + rng.index(3));
    for axis in (first..first + faces).map(|axis| axis % 3) {
        let at_min = rng.coin();
        origin[axis] = if at_min { bounds.min } else { bounds.max }[axis];
        if faces > 1 {
            dir[axis] = dir[axis].abs() * if at_min { 1.0 } else { -1.0 };
        }
    }
    Some(with_times(rng, origin, dir, sides.max_element()))
}

/// Picks a random ray that starts exactly at the centre of the box. Returns `None` if the centre
/// isn't exact in single precision.
fn from_center(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let center = bounds.center();
    let is_exact = center.as_vec3().as_dvec3() == center;
    let dir = fields::direction(rng);
    is_exact.then(|| with_times(rng, center, dir, bounds.half_side()))
}

/// Picks a random ray that starts exactly at the origin of the world.
fn from_the_origin(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let target = target(rng, bounds);
    let dir = target.try_normalize()?;
    let dir = if rng.index(8) == 0 { -dir } else { dir };
    let furthest = target.length() + 2.0 * bounds.half_side();
    Some(with_times(rng, DVec3::ZERO, dir, furthest))
}

/// Picks a random ray from an origin with one or two zero coordinates.
fn from_a_plane_of_axes(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let (dir, size) = (fields::direction(rng), bounds.half_side());
    let target = target(rng, bounds);
    let mut origin = target - size * rng.uniform(-0.5, 28.0) * dir;
    let (axis, zeros) = (rng.index(3), 1 + rng.index(2));
    for next in 0..zeros {
        origin[(axis + next) % 3] = 0.0;
    }
    let dir = (target - origin).try_normalize()?;
    let furthest = origin.distance(target) + 2.0 * size;
    with_times_in_scene(rng, origin, dir, furthest)
}

/// Picks a random ray that clips a corner or an edge of the box.
fn past_a_corner(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    let signs = DVec3::from_array([rng.sign(), rng.sign(), rng.sign()]);
    let is_long = sides.cmpge(DVec3::splat(0.5 * size));
    let part = if rng.coin() {
        DVec3::splat(rng.uniform(CORNER, 0.965))
    } else {
        rng.vector(0.88, 0.95)
    };
    let of_half = DVec3::select(is_long, part, rng.vector(0.0, 0.7));
    let corner = 0.5 * of_half * signs * sides;
    let dir = rng.perpendicular_to(corner.try_normalize()?);
    let ahead = size * rng.uniform(1.5, 25.0);
    let origin = bounds.center() + corner - ahead * dir;
    with_times_in_scene(rng, origin, dir, ahead + 2.0 * size)
}

/// Does the same as [`with_times`] but returns `None` if the ray starts outside the scene.
pub(super) fn with_times_in_scene(
    rng: &mut Rng,
    origin: DVec3,
    dir: DVec3,
    furthest: f64,
) -> Option<(Ray, Interval)> {
    let is_inside = origin.abs().max_element() <= fields::FURTHEST;
    is_inside.then(|| with_times(rng, origin, dir, furthest))
}

/// Returns a ray with a random range, and random times that end at distances up to `furthest`.
pub(super) fn with_times(
    rng: &mut Rng,
    origin: DVec3,
    dir: DVec3,
    furthest: f64,
) -> (Ray, Interval) {
    let mut times = fields::range(rng, furthest);
    match rng.index(16) {
        0 | 1 => times.max = times.min,
        2 => times.max = f32::MAX,
        _ => {}
    }
    let mut own = fields::range(rng, furthest);
    match rng.index(8) {
        0 => own.max = own.min,
        1 => own.max = own.min * rng.uniform(0.0, 0.9) as f32,
        2 => own.max = f32::MAX,
        _ => {}
    }
    let ray = Ray::new(origin.as_vec3(), dir.as_vec3()).within(own.min, own.max);
    (ray, times)
}
