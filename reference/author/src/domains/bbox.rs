//! The domain of `BBox::hit`.

use glam::{DVec3, Vec3};
use protocol::{Interval, Query, Question, Ray};

use super::fields::{
    self, DIRECTIONS, DISTANCES, OCTANTS, PLACES, RANGES, SIZES, direction_class, distance_class,
    history_class, octant, place_class, range_class, size_class,
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
        START, DISTANCE, OUTCOME, DIRECTION, TIMES, RAYS_RANGE, HISTORY,
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
        "flat along x",
        "flat along y",
        "flat along z",
    ],
    class: |call| {
        let sides = call.bounds.max - call.bounds.min;
        let flat = (0..3).find(|&axis| sides[axis] == 0.0);
        let class = match sides.min_element() / sides.max_element() {
            0.75.. => 0,
            0.02.. => 1,
            _ => 2,
        };
        Some(flat.map_or(class, |axis| 3 + axis))
    },
};

/// The start of the ray.
const START: Aspect<BoxCall> = Aspect {
    name: "start",
    classes: &["up to 3 sizes away", "up to 30 sizes away", "inside"],
    class: |call| {
        let start = call.ray.origin.as_dvec3();
        let sizes = (start - call.bounds.center()).abs().max_element() / call.size();
        Some(match sizes {
            _ if call.bounds.contains(&Bounds::around([start])) => 2,
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
    ],
    class: |call| {
        let line = Ray64::from(&call.ray).within(Interval::new(f32::NEG_INFINITY, f32::INFINITY));
        let (min, max) = (f64::from(call.times.min), f64::from(call.times.max));
        Some(match call.bounds.span(&line) {
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

/// The times.
const TIMES: Aspect<BoxCall> = Aspect {
    name: "times",
    classes: RANGES,
    class: |call| range_class(call.times),
};

/// The ray's own range, which does not matter.
const RAYS_RANGE: Aspect<BoxCall> = Aspect {
    name: "the ray's own range",
    classes: RANGES,
    class: |call| range_class(call.ray.range),
};

/// The call before.
const HISTORY: Aspect<BoxCall> = Aspect {
    name: "call before",
    classes: &["none", "another ray", "the same ray with other times"],
    class: |call| {
        let before = call.before.as_ref();
        Some(history_class(before.map(|(ray, _)| ray), &call.ray))
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

    fn other_subject(&self) -> Bounds {
        let half = 0.75 * 0.5 * (self.bounds.max - self.bounds.min);
        let center = self.bounds.center();
        Bounds::new((center - half).as_vec3(), (center + half).as_vec3())
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
            if is_flat.test(axis) {
                // A ray in the plane of a flat box is not tested.
                is_still.test(axis) && (origin - self.bounds.min)[axis].abs() < longer
            } else {
                margins[axis] < 8.0 * EPSILON * coordinates.max_element()
            }
        };
        if (0..3).any(is_lost) {
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

    /// Returns by how much the times can be shortened at each end.
    fn duration_margin(&self) -> f64 {
        let ray64 = self.ray64();
        (0.02 * self.size()).min(0.25 * (ray64.max - ray64.min))
    }
}

/// The relative error of one operation in single precision.
const EPSILON: f64 = 6e-8;

/// Draws a box of this size, which may be thin or flat.
fn drawn_box(rng: &mut Rng, size: usize) -> Bounds {
    let size = fields::size(rng, size);
    let least = if rng.coin() { 0.3 } else { 0.8 };
    let mut half = size * rng.vector(least, 1.0);
    let (axis, other) = (rng.index(3), rng.integer(1, 2) as usize);
    half[(axis + other) % 3] = size;
    match rng.index(4) {
        0 => half[axis] = 0.0,
        1 => half[axis] *= rng.uniform(0.005, 0.02),
        _ => {}
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
    let sides = bounds.max - bounds.min;
    let size = 0.5 * sides.max_element();
    let dir = fields::direction(rng);
    let target = match rng.index(4) {
        0 => bounds.center() + size * rng.point(2.0),
        1 => {
            // Close to a face, inside or outside.
            let axis = rng.index(3);
            let mut target = bounds.center() + 0.45 * rng.point(1.0) * sides;
            let half = 0.5 * sides[axis] + size * rng.sign() * rng.uniform(0.03, 0.15);
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
    let furthest = ahead.max(0.0) + 2.0 * size;
    let mut times = fields::range(rng, furthest);
    if rng.index(8) == 0 {
        times.max = times.min;
    }
    let own = fields::range(rng, furthest);
    let ray = Ray::new(origin.as_vec3(), dir.as_vec3()).within(own.min, own.max);
    Some((ray, times))
}

/// Draws boxes of these sizes, each with calls that belong to an idea, every other one a hit.
pub fn tables(
    rng: &mut Rng,
    sizes: &[usize],
    belongs: impl Fn(&BoxCall) -> bool,
) -> Vec<(Bounds, Vec<(Ray, Interval)>)> {
    let generator = Generator {
        domain: &BOX,
        subject: &drawn_box,
        input: &query,
        fits: &|call: &BoxCall| call.is_clear() && belongs(call),
    };
    generator.tables(rng, sizes)
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
