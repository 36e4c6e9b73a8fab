//! The domain of `BBox::hit`.

use glam::{DVec3, Vec3};
use protocol::{Interval, Query, Question, Ray};

use super::fields::{
    self, DIAGONALS, DIRECTIONS, DISTANCES, OCTANTS, PLACES, SIZES, diagonal_class,
    direction_class, distance_class, history_class, octant, place_class, range_class, size_class,
};
use super::{Aspect, Call, FunctionDomain, Generator, not_asked};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// The domain of `BBox::hit`.
pub static BOX: FunctionDomain<BoxCall> = FunctionDomain {
    function: "BBox::hit",
    subject_aspects: &[SIZE, PLACE, OCTANT, FORM],
    aspects: &[
        START, DISTANCE, OUTCOME, DIRECTION, DIAGONAL, SLANT, TIMES, RAYS_RANGE, HISTORY,
    ],
    pairs: &[["size", "direction"], ["size", "start"]],
    calls,
    not_asked: &[
        not_asked("distance", &[], &["`None`"], "A miss has no distance."),
        not_asked(
            "outcome",
            &["misses", "too late", "too early"],
            &[],
            "The box is missed.",
        ),
        not_asked(
            "outcome",
            &[
                "enters and leaves",
                "only leaves",
                "only enters",
                "inside throughout",
            ],
            &["`None`"],
            "The box is hit.",
        ),
        not_asked(
            "size",
            &["500"],
            &["pairs"],
            "Nothing is 30 sizes away from such a box in a scene whose coordinates end at a thousand.",
        ),
        not_asked(
            "outcome",
            &[
                "narrowly misses",
                "narrowly misses a flat box",
                "narrowly misses a flat strip",
            ],
            &[],
            "The box is missed.",
        ),
        not_asked(
            "components below 1e-4",
            &["lead into the box"],
            &["`None`"],
            "The box is hit.",
        ),
        not_asked(
            "components below 1e-4",
            &["lead past the box"],
            &["some", "interval inside the box"],
            "The box is missed.",
        ),
        not_asked(
            "start",
            &["on a face"],
            &["pairs"],
            "Far from the origin, no coordinate of a tiny box is exact enough.",
        ),
    ],
};

/// A call of `BBox::hit`.
#[derive(Clone, Copy, Debug)]
pub struct BoxCall {
    /// The box. Its corners are exact in single precision.
    pub bounds: Bounds,
    /// The ray.
    pub ray: Ray,
    /// The times.
    pub times: Interval,
    /// The arguments of the call before this one, if it was about the same box.
    before: Option<(Ray, Interval)>,
}

/// The size of the box: half of its longest side.
const SIZE: Aspect<BoxCall> = Aspect {
    name: "size",
    classes: SIZES,
    class: |call| Some(size_class(call.size())),
};

/// The position of the box.
const PLACE: Aspect<BoxCall> = Aspect {
    name: "place",
    classes: PLACES,
    class: |call| Some(place_class(call.bounds.center(), call.size())),
};

/// The octant of the box's position.
const OCTANT: Aspect<BoxCall> = Aspect {
    name: "octant",
    classes: OCTANTS,
    class: |call| octant(call.bounds.center()),
};

/// The form of the box.
const FORM: Aspect<BoxCall> = Aspect {
    name: "form",
    classes: &[
        "about a cube",
        "ordinary",
        "thin",
        "thin as paper",
        "thin along two axes",
        "flat and thin",
        "flat along x",
        "flat along y",
        "flat along z",
    ],
    class: |call| {
        let sides = call.bounds.max - call.bounds.min;
        let flat = (0..3).find(|&axis| sides[axis] == 0.0);
        let mut parts = (sides / sides.max_element()).to_array();
        parts.sort_by(f64::total_cmp);
        let [least, middle, _] = parts;
        let class = match (flat, least) {
            (Some(_), _) if middle < THREAD => FLAT_AND_THIN,
            (Some(axis), _) => 6 + axis,
            (None, _) if middle < THREAD => 4,
            (None, 0.75..) => 0,
            (None, THIN..) => 1,
            (None, PAPER..) => 2,
            (None, _) => 3,
        };
        Some(class)
    },
};

/// The class of flat boxes that are thin as well.
const FLAT_AND_THIN: usize = 5;
/// The sides of a box below which it is thin, relative to the longest.
const THIN: f64 = 0.02;
/// The second longest side of a box below which it is thin along two axes, relative to the longest.
const THREAD: f64 = 0.0025;
/// The shortest side of a box below which it is as thin as paper, relative to the longest.
const PAPER: f64 = 0.0009;

/// The start of the ray.
const START: Aspect<BoxCall> = Aspect {
    name: "start",
    classes: &[
        "up to 3 sizes away",
        "up to 30 sizes away",
        "inside",
        "on a face",
    ],
    class: |call| {
        let start = call.ray.origin.as_dvec3();
        let sizes = (start - call.bounds.center()).abs().max_element() / call.size();
        Some(match sizes {
            _ if call.bounds.contains(&Bounds::around([start])) => {
                let is_on_face = start.cmpeq(call.bounds.min) | start.cmpeq(call.bounds.max);
                2 + usize::from(is_on_face.any() && !call.is_flat())
            }
            ..3.0 => 0,
            _ => 1,
        })
    },
};

/// How the ray's line crosses the box, and which part of that is in the times.
const OUTCOME: Aspect<BoxCall> = Aspect {
    name: "outcome",
    classes: &[
        "enters and leaves",
        "only leaves",
        "only enters",
        "inside throughout",
        "misses",
        "too late",
        "too early",
        "narrowly misses",
        "narrowly misses a flat box",
        "narrowly misses a flat strip",
    ],
    class: |call| {
        let line = Ray64::from(&call.ray).within(Interval::new(f32::NEG_INFINITY, f32::INFINITY));
        let (min, max) = (f64::from(call.times.min), f64::from(call.times.max));
        Some(match call.bounds.span(&line) {
            None if call.is_narrow_miss(&line) => match (call.is_flat(), (FORM.class)(call)) {
                (false, _) => 7,
                (true, Some(FLAT_AND_THIN)) => 9,
                (true, _) => 8,
            },
            None => 4,
            Some((enter, _)) if enter > max => 5,
            Some((_, leave)) if leave < min => 6,
            Some((enter, leave)) => match (enter >= min, leave <= max) {
                (true, true) => 0,
                (false, true) => 1,
                (true, false) => 2,
                (false, false) => 3,
            },
        })
    },
};

/// The distance at which the ray enters the box.
const DISTANCE: Aspect<BoxCall> = Aspect {
    name: "distance",
    classes: DISTANCES,
    class: |call| Some(distance_class(call.bounds.span(&call.ray64())?.0)),
};

/// The direction of the ray.
const DIRECTION: Aspect<BoxCall> = Aspect {
    name: "direction",
    classes: DIRECTIONS,
    class: |call| direction_class(call.ray.dir),
};

/// The exact diagonals among the directions.
const DIAGONAL: Aspect<BoxCall> = Aspect {
    name: "diagonal",
    classes: DIAGONALS,
    class: |call| diagonal_class(call.ray.dir),
};

/// The components of the direction that are almost 0, if they decide.
const SLANT: Aspect<BoxCall> = Aspect {
    name: "components below 1e-4",
    classes: &["lead into the box", "lead past the box"],
    class: |call| {
        let with_zeros = call.with_zeros()?;
        let (is_hit, would_be_hit) = (call.is_hit(), with_zeros.is_hit());
        (is_hit != would_be_hit).then_some(usize::from(would_be_hit))
    },
};

/// The classes of times, and of the ray's own range, which may be empty.
const TIMES_CLASSES: &[&str] = &[
    "from 0 to ∞",
    "from 0 to an end",
    "from later to ∞",
    "from later to an end",
    "from 0 to a far end",
    "from later to a far end",
    "to the largest number",
    "one point",
];

/// The same, with one more for a range that is empty.
const RANGE_CLASSES: &[&str] = &[
    "from 0 to ∞",
    "from 0 to an end",
    "from later to ∞",
    "from later to an end",
    "from 0 to a far end",
    "from later to a far end",
    "to the largest number",
    "one point",
    "empty",
];

/// Returns the class of an interval in [`RANGE_CLASSES`].
fn times_class(times: Interval) -> Option<usize> {
    match times {
        _ if times.min > times.max => Some(8),
        _ if times.min == times.max => Some(7),
        _ if times.max == f32::MAX => Some(6),
        _ => range_class(times),
    }
}

/// The times.
const TIMES: Aspect<BoxCall> = Aspect {
    name: "times",
    classes: TIMES_CLASSES,
    class: |call| times_class(call.times),
};

/// The ray's own range, which does not matter.
const RAYS_RANGE: Aspect<BoxCall> = Aspect {
    name: "the ray's own range",
    classes: RANGE_CLASSES,
    class: |call| times_class(call.ray.range),
};

/// The call before.
const HISTORY: Aspect<BoxCall> = Aspect {
    name: "call before",
    classes: &[
        "none",
        "another ray",
        "the same ray with other times",
        "a parallel ray",
        "another ray from the same start",
    ],
    class: |call| {
        let before = call.before.as_ref().map(|(ray, _)| ray);
        let is_parallel = |ray: &Ray| ray.dir == call.ray.dir && ray.origin != call.ray.origin;
        if before.is_some_and(is_parallel) {
            return Some(3);
        }
        if before.is_some_and(|ray| ray.origin == call.ray.origin && ray.dir != call.ray.dir) {
            return Some(4);
        }
        Some(history_class(before, &call.ray))
    },
};

fn calls(question: &Question) -> Vec<BoxCall> {
    let Question::BBoxHit(table) = question else {
        return Vec::new();
    };
    let bounds = Bounds::new(table.subject.min, table.subject.max);
    let rows = table.rows.to_vec();
    let mut before = None;
    let calls = rows.iter().map(|&Query { ray, times }| BoxCall {
        bounds,
        ray,
        times,
        before: before.replace((ray, times)),
    });
    calls.collect()
}

impl Call for BoxCall {
    type Subject = Bounds;
    type Input = (Ray, Interval);

    fn new(bounds: Bounds, (ray, times): (Ray, Interval)) -> Self {
        BoxCall {
            bounds,
            ray,
            times,
            before: None,
        }
    }

    fn subject(&self) -> Bounds {
        self.bounds
    }

    fn input(&self) -> (Ray, Interval) {
        (self.ray, self.times)
    }

    fn is_hit(&self) -> bool {
        self.bounds.span(&self.ray64()).is_some()
    }

    fn with_other_range(&self, rng: &mut Rng) -> Option<Self> {
        let (_, leave) = self.bounds.span(&self.ray64())?;
        let leave = if leave.is_finite() { leave } else { 0.0 };
        let times = fields::range(rng, leave + 2.0 * self.size());
        Some(BoxCall { times, ..*self })
    }
}

impl BoxCall {
    /// Returns half of the longest side.
    fn size(&self) -> f64 {
        0.5 * (self.bounds.max - self.bounds.min).max_element()
    }

    /// Returns the part of the ray that is asked about.
    pub fn ray64(&self) -> Ray64 {
        Ray64::from(&self.ray).within(self.times)
    }

    /// Returns whether the times are from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.times == Interval::AHEAD
    }

    /// Returns whether the box has no thickness along an axis.
    pub fn is_flat(&self) -> bool {
        self.bounds.min.cmpeq(self.bounds.max).any()
    }

    /// Returns whether the direction has a component that is 0.
    pub fn is_parallel(&self) -> bool {
        self.ray.dir.cmpeq(Vec3::ZERO).any()
    }

    /// Returns whether the ray starts in the box.
    pub fn starts_inside(&self) -> bool {
        let start = Bounds::around([self.ray.origin.as_dvec3()]);
        self.bounds.contains(&start)
    }

    /// Returns the call with 0 for each component of the direction that is almost 0, or `None` if none
    /// is.
    fn with_zeros(&self) -> Option<BoxCall> {
        let is_small = self.ray.dir.abs().cmplt(Vec3::splat(SMALL_COMPONENT));
        let dir = Vec3::select(is_small, Vec3::ZERO, self.ray.dir);
        let ray = Ray { dir, ..self.ray };
        (dir != self.ray.dir).then_some(BoxCall { ray, ..*self })
    }

    /// Returns whether it matters that a component of the direction is almost 0, and not 0.
    pub fn is_decided_by_slant(&self) -> bool {
        (SLANT.class)(self).is_some()
    }

    /// Returns whether this line, which misses the box, would hit one that is a little larger.
    fn is_narrow_miss(&self, line: &Ray64) -> bool {
        /// By how much, in sizes.
        const NARROW: f64 = 0.002;
        let larger = self.bounds.grown(NARROW * self.size());
        larger.span(line).is_some()
    }

    /// Returns the times at which the ray's line enters and leaves the box, whatever the times are.
    pub fn crossing(&self) -> Option<(f64, f64)> {
        let whole = Interval::new(f32::NEG_INFINITY, f32::INFINITY);
        self.bounds.span(&Ray64::from(&self.ray).within(whole))
    }

    /// Returns whether every correct formula in single precision agrees on the outcome: it would be the
    /// same if the box and the times were a little larger or smaller.
    pub fn is_clear(&self) -> bool {
        /// How much larger or smaller, in sizes.
        const MARGIN: f64 = 0.02;
        /// The same for a thin box, in sides.
        const THIN_MARGIN: f64 = 0.1;
        let size = self.size();
        let sides = self.bounds.max - self.bounds.min;
        let margins = (THIN_MARGIN * sides).min(DVec3::splat(MARGIN * size));
        let (shorter, longer) = (self.duration_margin(), MARGIN * size);
        let is_flat = sides.cmpeq(DVec3::ZERO);
        let is_still = self.ray.dir.cmpeq(Vec3::ZERO);
        let origin = self.ray.origin.as_dvec3();
        let coordinates = origin
            .abs()
            .max(self.bounds.min.abs())
            .max(self.bounds.max.abs());
        let is_lost = |axis: usize| {
            let speed = f64::from(self.ray.dir[axis].abs());
            if is_flat.test(axis) && is_still.test(axis) {
                // A ray in the plane of a flat box is not tested.
                (origin - self.bounds.min)[axis].abs() < longer
            } else if is_flat.test(axis) {
                // Where a slanting ray crosses the plane depends on the rounding of the time.
                let late = 8.0 * EPSILON * coordinates.max_element() / speed;
                let is_far = |other: usize| {
                    let away = late * f64::from(self.ray.dir[other].abs());
                    !is_flat.test(other) && away > 0.25 * margins[other]
                };
                let time = (self.bounds.min - origin)[axis] / f64::from(self.ray.dir[axis]);
                let ends = [self.times.min, self.times.max].map(f64::from);
                let is_at_an_end = ends.iter().any(|end| (end - time).abs() < late);
                is_at_an_end || late > 0.25 * longer || (0..3).any(is_far)
            } else {
                // A ray in the plane of a face is not tested, either.
                let sides = [self.bounds.min, self.bounds.max];
                let is_in_plane = sides.iter().any(|side| side[axis] == origin[axis]);
                is_still.test(axis) && is_in_plane
                    || margins[axis] < 8.0 * EPSILON * coordinates.max_element()
            }
        };
        let distance = (origin - self.bounds.center()).abs().max_element();
        if distance > fields::FURTHEST_SIZES * size
            || (0..3).any(is_lost)
            || self.is_decided_by_rounding(coordinates.max_element())
        {
            return false;
        }
        let hits_with = |sign: f64, margin: f64| {
            let bounds = Bounds {
                min: self.bounds.min - sign * margins,
                max: self.bounds.max + sign * margins,
            };
            let ray64 = self.ray64();
            let ray64 = Ray64 {
                min: ray64.min - sign * margin,
                max: ray64.max + sign * margin,
                ..ray64
            };
            bounds.span(&ray64).is_some()
        };
        hits_with(1.0, longer) == hits_with(-1.0, shorter)
    }

    /// Returns whether the ray enters or leaves the box through a side that it is almost parallel to, so
    /// that rounding changes the time.
    fn is_decided_by_rounding(&self, coordinates: f64) -> bool {
        /// The largest part of a tolerance that errors may take.
        const PART: f64 = 0.3;
        let ray64 = self.ray64();
        let Some((enter, leave)) = self.bounds.span(&ray64) else {
            return false;
        };
        (0..3).any(|axis| {
            let speed = ray64.dir[axis];
            let sides = [self.bounds.min, self.bounds.max];
            let times = sides.map(|side| (side - ray64.origin)[axis] / speed);
            let error = 4.0 * EPSILON * coordinates / speed.abs();
            let decides = |end: f64| times.iter().any(|time| (time - end).abs() <= 4.0 * error);
            speed != 0.0 && error > PART * 1e-4 * coordinates && (decides(enter) || decides(leave))
        })
    }

    /// Returns by how much the times can be shortened at each end.
    fn duration_margin(&self) -> f64 {
        let ray64 = self.ray64();
        (0.02 * self.size()).min(0.25 * (ray64.max - ray64.min))
    }
}

/// The relative error of one operation in single precision.
const EPSILON: f64 = 6e-8;

/// The components of a direction that are almost 0.
const SMALL_COMPONENT: f32 = 1e-4;

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
    let size = 0.5 * sides.max_element();
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
    let size = 0.5 * sides.max_element();
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

/// Returns a smaller box with the same centre.
fn smaller(bounds: &Bounds) -> Bounds {
    let half = 0.75 * 0.5 * (bounds.max - bounds.min);
    let center = bounds.center();
    Bounds::new((center - half).as_vec3(), (center + half).as_vec3())
}

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
        similar: &|call| BoxCall::new(smaller(&call.bounds), call.input()),
        fits: &fits,
    };
    let tables = generator.tables(rng, sizes).into_iter();
    tables
        .map(|table| with_related_rays(rng, table, fits))
        .collect()
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
