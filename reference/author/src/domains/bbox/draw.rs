//! Generates random boxes, rays through and past them, and times.

use glam::DVec3;
use protocol::{Interval, Ray};

use super::aspects::{CALL_ASPECTS, CORNER, DISTANT, FOIL, SUBJECT_ASPECTS, THIN, THREAD};
use super::call::{BoxCall, SMALL_COMPONENT};
use super::history::FOLLOW;
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

/// Picks a random box of this size. Up to two sides may be thin, and one may be flat.
fn drawn_box(rng: &mut Rng, size: usize) -> Bounds {
    let size = fields::size(rng, size);
    let is_cube = rng.index(6) == 0;
    let least = if rng.coin() { 0.3 } else { 0.8 };
    let mut half = size * rng.vector(least, 1.0);
    let (axis, other) = (rng.index(3), rng.integer(1, 2) as usize);
    half[(axis + other) % 3] = size;
    let mut is_foil = false;
    match rng.index(8) {
        _ if is_cube => half = DVec3::splat(size),
        0 | 1 => half[axis] = 0.0,
        2 | 3 => half[axis] *= thin(rng),
        4 => {
            half[axis] = size * rng.log_uniform(8e-5, 0.95 * FOIL);
            is_foil = true;
        }
        _ => {}
    }
    if half[axis] < THIN * size && !is_foil && rng.index(3) == 0 {
        half[(axis + 3 - other) % 3] = size * thin(rng);
    }
    // Farther away, coordinates don't have enough digits to represent a box as thin as foil.
    let mut center = if is_foil {
        rng.point(0.9 * size)
    } else {
        fields::place(rng, size)
    };
    match rng.index(10) {
        0 => center = half * DVec3::from_array([rng.sign(), rng.sign(), rng.sign()]),
        1 => center[axis] = half[axis] * rng.sign(),
        2..=5 => [center, half] = exact(size, [center, half]),
        6 => {
            half[axis] = half[(axis + 1) % 3];
            [center, half] = exact(size, [center, half]);
        }
        _ if is_cube => [center, half] = exact(size, [center, half]),
        _ => {}
    }
    let mut bounds = Bounds::new((center - half).as_vec3(), (center + half).as_vec3());
    if half[axis] == 0.0 {
        bounds.max[axis] = bounds.min[axis];
    }
    bounds
}

/// Picks a random length for a short side, as a fraction of the box's size.
fn thin(rng: &mut Rng) -> f64 {
    match rng.index(3) {
        0 => rng.uniform(0.005, THIN),
        _ => rng.log_uniform(2e-4, THREAD),
    }
}

/// Returns a centre and half sides close to the given ones, such that the corners and the centre
/// are exact in single precision. Half sides that are too short for that are returned unchanged.
fn exact(size: f64, [center, half]: [DVec3; 2]) -> [DVec3; 2] {
    let step = size.log2().floor().exp2() / 256.0;
    let is_long = half.cmpge(DVec3::splat(step));
    let shorter = (half / step).floor() * step;
    [
        (center / step).trunc() * step,
        DVec3::select(is_long, shorter, half),
    ]
}

/// Picks random times, and a random ray that passes through or beside a box. Returns `None` if the
/// ray would start too far away.
fn query(rng: &mut Rng, bounds: &Bounds) -> Option<(Ray, Interval)> {
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
fn query_along(rng: &mut Rng, bounds: &Bounds, dir: DVec3) -> Option<(Ray, Interval)> {
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
fn with_times_in_scene(
    rng: &mut Rng,
    origin: DVec3,
    dir: DVec3,
    furthest: f64,
) -> Option<(Ray, Interval)> {
    let is_inside = origin.abs().max_element() <= fields::FURTHEST;
    is_inside.then(|| with_times(rng, origin, dir, furthest))
}

/// Returns a ray with a random range, and random times that end at distances up to `furthest`.
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

/// Returns a box that is shorter along an axis but has exactly the same centre in single precision.
fn shorter(bounds: &Bounds, axis: usize) -> Bounds {
    /// The number of side lengths to try.
    const ATTEMPTS: usize = 256;
    let twice = bounds.min + bounds.max;
    let (mut min, mut max) = (bounds.min.as_vec3(), bounds.max.as_vec3());
    if min[axis] == max[axis] {
        return *bounds;
    }
    let shorter = 0.125 * (bounds.max - bounds.min)[axis];
    let mut low = (bounds.min[axis] + shorter) as f32;
    let mut high = || {
        low = low.next_up();
        (low, twice[axis] - f64::from(low))
    };
    let sides = (0..ATTEMPTS).map(|_| high());
    let sides: Vec<(f32, f64)> = sides.collect();
    let is_exact = |(_, high): &&(f32, f64)| f64::from(*high as f32) == *high;
    let (low, high) = *sides.iter().find(is_exact).unwrap_or(&sides[0]);
    (min[axis], max[axis]) = (low, high as f32);
    Bounds::new(min, max)
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
