//! Generates tables of random boxes and random calls on them.

use glam::DVec3;
use protocol::{Interval, Ray};

use super::aspects::{CALL_ASPECTS, SUBJECT_ASPECTS, THIN};
use super::boxes::{drawn_box, shorter};
use super::call::BoxCall;
use super::history::FOLLOW;
use super::queries::{query, query_along, with_times, with_times_in_scene};
use crate::domains::fields;
use crate::domains::{Call, Change, Generator};
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Generates random boxes of these sizes and, for each box, random calls that fit the idea an item
/// tests. Half of the calls are hits.
pub fn tables(
    rng: &mut Rng,
    sizes: &[usize],
    belongs: impl Fn(&BoxCall) -> bool,
) -> Vec<(Bounds, Vec<(Ray, Interval)>)> {
    let fits = |call: &BoxCall| call.is_clear() && belongs(call);
    let generator = Generator {
        subject_aspects: SUBJECT_ASPECTS,
        call_aspects: CALL_ASPECTS,
        subject: &drawn_box,
        input: &query,
        changes: CHANGES,
        most_changes: 3,
        follow: FOLLOW,
        fits: &fits,
        differ: &|one, other| one.differs(other),
    };
    let mut tables = generator.tables(rng, sizes);
    // If the last tables repeat earlier calls, leave them unchanged, because each of them begins
    // with the last call of the table before it.
    let alone = if tables.len() > sizes.len() {
        sizes.len() - 1
    } else {
        tables.len()
    };
    let rest = tables.split_off(alone);
    let tables = tables.into_iter().map(|table| {
        let table = with_related_rays(rng, table, fits);
        with_almost_the_same_rays(rng, table, fits)
    });
    tables.collect::<Vec<_>>().into_iter().chain(rest).collect()
}

/// The ways a box can differ from the previous one.
const CHANGES: &[Change<BoxCall>] = &[
    |call, random| with_moved_face(call, random, true, 0.006 + 0.003 * random.y),
    |call, _| BoxCall::new(shorter(&call.bounds, 0), call.input()),
    |call, _| BoxCall::new(shorter(&call.bounds, 1), call.input()),
    |call, _| BoxCall::new(shorter(&call.bounds, 2), call.input()),
    |call, random| with_moved_face(call, random, random.max_element() > 0.5, 0.2),
];

/// Returns the call with a box that is shorter along a random axis by this part of its side.
fn with_moved_face(call: &BoxCall, random: DVec3, at_max: bool, part: f64) -> BoxCall {
    let Bounds { mut min, mut max } = call.bounds;
    let axis = random.max_position();
    let moved = part * (max - min)[axis];
    if at_max {
        max[axis] -= moved;
    } else {
        min[axis] += moved;
    }
    BoxCall::new(Bounds::new(min.as_vec3(), max.as_vec3()), call.input())
}

/// Returns the calls in a table. If the box is thin enough, adds three calls whose rays are almost
/// the same but alternate between clear hits and clear misses.
fn with_almost_the_same_rays(
    rng: &mut Rng,
    (bounds, mut queries): (Bounds, Vec<(Ray, Interval)>),
    fits: impl Fn(&BoxCall) -> bool,
) -> (Bounds, Vec<(Ray, Interval)>) {
    /// The maximum number of random rays to try.
    const ATTEMPTS: usize = 3000;
    let sides = bounds.max - bounds.min;
    let size = bounds.half_side();
    let thick = (0..3).filter(|&axis| sides[axis] > 0.0);
    let thinnest = thick.min_by(|&a, &b| sides[a].total_cmp(&sides[b]));
    let Some(axis) = thinnest.filter(|&axis| sides[axis] < THIN * size) else {
        return (bounds, queries);
    };
    let found = rng.attempt(ATTEMPTS, |rng| {
        let mut dir = fields::direction(rng);
        if rng.coin() {
            dir[axis] = 0.0;
            dir = dir.try_normalize()?;
        }
        let mut target = bounds.center() + 0.4 * rng.point(1.0) * sides;
        let from_center = rng.sign() * rng.uniform(0.3, 0.7) * sides[axis];
        target[axis] = bounds.center()[axis] + from_center;
        let ahead = size * rng.uniform(10.0, 28.0);
        let origin = target - ahead * dir;
        let (ray, times) = with_times_in_scene(rng, origin, dir, ahead + 2.0 * size)?;
        let other = fields::almost_the_same_ray(rng, &ray);
        let calls = [ray, other].map(|ray| BoxCall::new(bounds, (ray, times)));
        let [first, second] = &calls;
        let is_other = first.is_hit() != second.is_hit();
        (is_other && calls.iter().all(&fits)).then_some(calls.map(|call| call.input()))
    });
    if let Some([first, second]) = found {
        queries.extend([first, second, first]);
    }
    (bounds, queries)
}

/// Returns degenerate boxes (a line along each axis, and a point), each with rays that clearly miss
/// it.
pub fn lines_and_a_point(rng: &mut Rng) -> Vec<(Bounds, Vec<(Ray, Interval)>)> {
    /// The number of rays for each box.
    const RAYS: usize = 8;
    /// The minimum distance between a ray and the box, as a multiple of the box's size.
    const CLEAR: f64 = 0.05;
    let table = |axis: usize| {
        let class = 1 + rng.index(7);
        let size = fields::size(rng, class);
        let half = DVec3::AXES
            .get(axis)
            .map_or(DVec3::ZERO, |axis| size * *axis);
        let center =
            fields::place(rng, size).clamp(DVec3::splat(-60.0 * size), DVec3::splat(60.0 * size));
        let [min, max] = [-half, half].map(|half| (center.as_vec3().as_dvec3() + half).as_vec3());
        let bounds = Bounds::new(min, max);
        let ray = |_| {
            rng.retry(|rng| {
                let beside = size * rng.uniform(0.1, 1.2) * rng.direction();
                let target = bounds.center() + 0.9 * rng.point(1.0) * half + beside;
                let dir = if rng.index(4) == 0 {
                    fields::diagonal(rng)
                } else {
                    fields::direction(rng)
                };
                let ahead = size * rng.uniform(-0.5, 20.0);
                let origin = target - ahead * dir;
                let query = with_times(rng, origin, dir, ahead.max(0.0) + 2.0 * size);
                let around = BoxCall::new(bounds.grown(CLEAR * size), query);
                let is_inside = origin.abs().max_element() <= fields::FURTHEST;
                (is_inside && around.crossing().is_none()).then_some(query)
            })
        };
        (bounds, (0..RAYS).map(ray).collect())
    };
    (0..4).map(table).collect()
}

/// Returns the calls in a table, with up to three calls added. Two of the new rays are parallel to
/// the previous ray, and the third starts at the same point as the previous ray. Each new ray hits
/// if the previous ray misses, and vice versa.
fn with_related_rays(
    rng: &mut Rng,
    (bounds, mut queries): (Bounds, Vec<(Ray, Interval)>),
    fits: impl Fn(&BoxCall) -> bool,
) -> (Bounds, Vec<(Ray, Interval)>) {
    /// The maximum number of random rays to try for each new call.
    const ATTEMPTS: usize = 400;
    let is_hit = |query: &(Ray, Interval)| BoxCall::new(bounds, *query).is_hit();
    // The first new ray is parallel to the ray in the last row. If necessary, a different row is
    // moved to the end for this purpose.
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
    // The last new call has the same start and times as the row that it is inserted after.
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

    /// Computes the times by multiplying by the inverse of the direction, in single precision.
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
