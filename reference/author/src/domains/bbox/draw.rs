//! Draws boxes, and rays through and beside them with times.

use glam::DVec3;
use protocol::{Interval, Ray};

use super::call::{BoxCall, SMALL_COMPONENT};
use super::{BOX, THIN, THREAD};
use crate::domains::fields;
use crate::domains::{Call, Generator};
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Draws boxes of these sizes, each with calls that belong to an idea, every other one a hit.
pub fn tables(
    rng: &mut Rng,
    sizes: &[usize],
    belongs: impl Fn(&BoxCall) -> bool,
) -> Vec<(Bounds, Vec<(Ray, Interval)>)> {
    let fits = |call: &BoxCall| call.is_clear() && belongs(call);
    let generator = Generator {
        domain: &BOX,
        subject: &drawn_box,
        input: &query,
        changes: &[|call, _| BoxCall::new(smaller(&call.bounds), call.input())],
        most_changes: 1,
        follow: &[],
        fits: &fits,
        differ: &|_, _| true,
    };
    let tables = generator.tables(rng, sizes).into_iter();
    tables
        .map(|table| with_related_rays(rng, table, fits))
        .collect()
}

/// Draws a box of this size. Each of two sides may be thin, and one may be flat.
fn drawn_box(rng: &mut Rng, size: usize) -> Bounds {
    let size = fields::size(rng, size);
    let least = if rng.coin() { 0.3 } else { 0.8 };
    let mut half = size * rng.vector(least, 1.0);
    let (axis, other) = (rng.index(3), rng.integer(1, 2) as usize);
    half[(axis + other) % 3] = size;
    let thin = |rng: &mut Rng| match rng.index(3) {
        0 => rng.uniform(0.005, THIN),
        _ => rng.log_uniform(2e-4, THREAD),
    };
    match rng.index(4) {
        0 => half[axis] = 0.0,
        1 => half[axis] *= thin(rng),
        _ => {}
    }
    if half[axis] < THIN * size && rng.index(3) == 0 {
        half[(axis + 3 - other) % 3] = size * thin(rng);
    }
    let center = fields::place(rng, size);
    let mut bounds = Bounds::new((center - half).as_vec3(), (center + half).as_vec3());
    if half[axis] == 0.0 {
        bounds.max[axis] = bounds.min[axis];
    }
    bounds
}

/// Draws a ray through a box or beside it, with times. Returns `None` if it would start too far away.
fn query(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let dir = match rng.index(16) {
        0 | 1 => fields::diagonal(rng),
        2 | 3 => return slanted(rng, bounds),
        4 => return from_face(rng, bounds),
        _ => fields::direction(rng),
    };
    query_along(rng, bounds, dir)
}

/// Draws a ray in this direction. Some start far away in another.
fn query_along(rng: &mut Rng, bounds: &Bounds, dir: DVec3) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    let target = match rng.index(4) {
        0 => bounds.center() + size * rng.point(2.0),
        1 => {
            // Close to a face, inside or outside: by a part of the box's size, or of this side.
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
    };
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

/// Draws a ray with a component that is almost 0, along a slab that it starts beside, or that it leaves
/// on its long way to the box.
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
    let is_inside = origin.abs().max_element() <= fields::FURTHEST;
    is_inside.then(|| with_times(rng, origin, dir, ahead + 2.0 * size))
}

/// Draws a ray that starts exactly on a face of the box.
fn from_face(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
    let sides = bounds.max - bounds.min;
    let mut origin = bounds.center() + 0.4 * rng.point(1.0) * sides;
    let axis = rng.index(3);
    origin[axis] = if rng.coin() {
        bounds.min[axis]
    } else {
        bounds.max[axis]
    };
    let dir = fields::direction(rng);
    Some(with_times(rng, origin, dir, sides.max_element()))
}

/// Returns a ray with its own range and times, whose ends are at distances up to `furthest`.
fn with_times(rng: &mut Rng, origin: DVec3, dir: DVec3, furthest: f64) -> (Ray, Interval) {
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

/// Returns a smaller box with the same centre.
fn smaller(bounds: &Bounds) -> Bounds {
    let half = 0.75 * 0.5 * (bounds.max - bounds.min);
    let center = bounds.center();
    Bounds::new((center - half).as_vec3(), (center + half).as_vec3())
}

/// Returns the calls of a table, and three more: two rays that are parallel to the one before, and one
/// with the same start. Where one of them hits, the other misses.
fn with_related_rays(
    rng: &mut Rng,
    (bounds, mut queries): (Bounds, Vec<(Ray, Interval)>),
    fits: impl Fn(&BoxCall) -> bool,
) -> (Bounds, Vec<(Ray, Interval)>) {
    /// How many rays are drawn for each.
    const ATTEMPTS: usize = 400;
    let is_hit = |query: &(Ray, Interval)| BoxCall::new(bounds, *query).is_hit();
    // The first is parallel to the last row, or to one that is moved to the end for it.
    let found = (0..queries.len()).rev().find_map(|row| {
        let last = queries[row];
        let dir = last.0.dir;
        let mut other = |hits: bool| {
            rng.attempt(ATTEMPTS, |rng| {
                let query = query_along(rng, &bounds, dir.as_dvec3())?;
                let fits = query.0.dir == dir && fits(&BoxCall::new(bounds, query));
                (fits && is_hit(&query) == hits).then_some(query)
            })
        };
        let first = other(!is_hit(&last))?;
        let second = other(is_hit(&last))?;
        Some((row, [first, second]))
    });
    if let Some((row, parallel)) = found {
        let last = queries.remove(row);
        queries.push(last);
        queries.extend(parallel);
    }
    // Some row is followed by one from the same start, with the same times.
    let found = (0..queries.len()).rev().find_map(|row| {
        let (ray, times) = queries[row];
        let other = rng.attempt(ATTEMPTS, |rng| {
            let target = bounds.center() + 0.45 * rng.point(1.5) * (bounds.max - bounds.min);
            let dir = (target - ray.origin.as_dvec3()).normalize().as_vec3();
            let query = (Ray { dir, ..ray }, times);
            let is_other = is_hit(&query) != is_hit(&(ray, times));
            (is_other && fits(&BoxCall::new(bounds, query))).then_some(query)
        })?;
        Some((row, other))
    });
    if let Some((row, other)) = found {
        queries.insert(row + 1, other);
    }
    (bounds, queries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    /// Products with the inverse of the direction, in single precision.
    fn span(call: &BoxCall) -> Option<(f32, f32)> {
        let (origin, inverse) = (call.ray.origin, call.ray.dir.recip());
        let (mut enter, mut leave) = (call.times.min, call.times.max);
        for axis in 0..3 {
            let (low, high) = (call.bounds.min[axis] as f32, call.bounds.max[axis] as f32);
            if inverse[axis].is_infinite() {
                if origin[axis] < low || origin[axis] > high {
                    return None;
                }
                continue;
            }
            let [a, b] = [low, high].map(|at| at * inverse[axis] - origin[axis] * inverse[axis]);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        (enter <= leave).then_some((enter, leave))
    }

    #[test]
    fn a_usual_formula_in_single_precision_stays_within_the_tolerances() {
        for seed in 0..8 {
            let mut rng = Seed(seed).rng("bbox");
            for (bounds, queries) in tables(&mut rng, fields::EVERY_SIZE, |_| true) {
                for query in queries {
                    let call = BoxCall::new(bounds, query);
                    let (got, expected) = (span(&call), bounds.span(&call.ray64()));
                    assert_eq!(got.is_some(), expected.is_some(), "{call:?}");
                    let (Some(got), Some(expected)) = (got, expected) else {
                        continue;
                    };
                    let corners = bounds.min.abs().max(bounds.max.abs());
                    let scale = corners.max(call.ray.origin.as_dvec3().abs()).max_element();
                    let error = (f64::from(got.0) - expected.0).abs();
                    let error = error.max((f64::from(got.1) - expected.1).abs());
                    assert!(error < 0.5e-4 * scale, "{call:?}");
                }
            }
        }
    }
}
