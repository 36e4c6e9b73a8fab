//! The domain of `Sphere::hit`.

use std::f64::consts::TAU;

use glam::DVec3;
use protocol::{Interval, Ray, Shape};

use super::fields::{self, FURTHEST_SIZES};
use super::shape::{
    self, DIRECTION, DISTANCE, HISTORY, NUMBER, OCTANT, PLACE, RANGE, SIZE, ShapeCall,
};
use super::{Aspect, Call, FunctionDomain, Generator, not_asked};
use crate::oracle::sphere::Sphere;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// The domain of `Sphere::hit`.
pub static SPHERE: FunctionDomain<ShapeCall> = FunctionDomain {
    pairs: &[["size", "direction"], ["size", "start"]],
    calls: shape::calls,
    function: "Sphere::hit",
    subject_aspects: &[SIZE, PLACE, OCTANT, NUMBER],
    aspects: &[
        START, DISTANCE, LINE, LATITUDE, DIRECTION, RANGE, END, HISTORY,
    ],
    not_asked: &[
        not_asked("distance", &[], &["`None`"], "A miss has no distance."),
        not_asked("latitude", &[], &["`None`"], "A miss has no latitude."),
        not_asked(
            "place",
            &["1,000 sizes away"],
            &["normal", "unit_normal", "uv"],
            "So far from the origin, rounding the centre changes the normal by more than its tolerance allows.",
        ),
        not_asked(
            "start",
            &["behind"],
            &[],
            "A sphere behind the ray is not hit.",
        ),
        not_asked(
            "line",
            &["grazing, outside", "outside"],
            &[],
            "A line outside of the sphere hits nothing.",
        ),
        not_asked(
            "size",
            &["500"],
            &["pairs"],
            "Nothing is 30 radii away from such a sphere in a scene whose coordinates end at a thousand.",
        ),
        not_asked(
            "distance",
            &["2000"],
            &["normal", "unit_normal", "origin", "position", "shape", "uv"],
            "Only the largest spheres are hit so far away, so an exam may ask it for the distance alone.",
        ),
    ],
};

/// The start of the ray, seen from the sphere.
const START: Aspect<ShapeCall> = Aspect {
    name: "start",
    classes: &[
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
    class: |call| {
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
};

/// The distance of the ray's line from the centre.
const LINE: Aspect<ShapeCall> = Aspect {
    name: "line",
    classes: &[
        "through the centre",
        "inside",
        "grazing, inside",
        "grazing, outside",
        "outside",
    ],
    class: |call| {
        Some(match Line::of(call)?.approach {
            ..1e-3 => 0,
            ..0.9 => 1,
            ..1.0 => 2,
            ..1.15 => 3,
            _ => 4,
        })
    },
};

/// The distance from a root that counts as near, in radii.
const NEAR: f64 = 0.1;

/// The distance of the hit from the axis through the poles.
const LATITUDE: Aspect<ShapeCall> = Aspect {
    name: "latitude",
    classes: &["near a pole", "anywhere"],
    class: |call| {
        let line = Line::of(call)?;
        Some(usize::from(line.from_pole(line.hits().next()?) > NEAR))
    },
};

/// The ends of the range, seen from the roots.
const END: Aspect<ShapeCall> = Aspect {
    name: "end of the range",
    classes: &["just before or behind a root", "anywhere"],
    class: |call| {
        let line = Line::of(call)?;
        let ends = [line.ray64.min, line.ray64.max];
        let mut distances = ends
            .iter()
            .flat_map(|end| line.roots.map(|root| (root - end).abs()));
        Some(usize::from(
            !distances.any(|it| it < 0.02 * line.sphere.radius),
        ))
    },
};

/// The line of a call's ray, and the sphere.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The sphere.
    pub sphere: Sphere,
    /// The ray.
    pub ray64: Ray64,
    /// The smallest distance from the centre, in radii.
    pub approach: f64,
    /// The distances at which the line enters and leaves the sphere, or NaN.
    pub roots: [f64; 2],
}

impl Line {
    /// Returns the line of a call, or `None` if its shape is no sphere.
    pub fn of(call: &ShapeCall) -> Option<Line> {
        let Shape::Sphere { center, radius, .. } = call.shape else {
            return None;
        };
        let sphere = Sphere {
            center: center.as_dvec3(),
            radius: radius.into(),
        };
        let ray64 = Ray64::from(&call.ray);
        let line = sphere.intersect_line(&ray64);
        Some(Line {
            sphere,
            ray64,
            approach: line.closest_approach,
            roots: line.roots,
        })
    }

    /// Returns the distance of the ray's start from the centre, in radii.
    fn start(&self) -> f64 {
        self.ray64.origin.distance(self.sphere.center) / self.sphere.radius
    }

    /// Returns how far a point of the ray on the sphere is from the axis through the poles, in radii.
    fn from_pole(&self, distance: f64) -> f64 {
        let radial = (self.ray64.at(distance) - self.sphere.center) / self.sphere.radius;
        radial.x.hypot(radial.z)
    }

    /// Returns whether the line misses the sphere.
    pub fn misses(&self) -> bool {
        self.approach > 1.0
    }

    /// Returns whether the range of the ray is from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.ray64.min == 0.0 && self.ray64.max == f64::INFINITY
    }

    /// Returns the roots in the ray's range.
    pub fn hits(&self) -> impl Iterator<Item = f64> + '_ {
        self.roots
            .into_iter()
            .filter(|&root| self.ray64.is_in_range(root))
    }

    /// Returns how wrong a distance may be if it is computed in single precision by a usual formula.
    /// The difference b² − c loses digits as the square of the distance from the centre grows, and the
    /// square root passes on more of that loss the closer the ray is to a tangent.
    fn distance_error(&self) -> f64 {
        let from_center = self
            .ray64
            .origin
            .distance(self.sphere.center)
            .max(self.sphere.radius);
        let half_chord = 0.5 * (self.roots[1] - self.roots[0]);
        EPSILON * (4.0 * from_center * from_center / half_chord + 2.0 * self.coordinates())
    }

    /// Returns the largest coordinate of the ray and the sphere.
    fn coordinates(&self) -> f64 {
        let sphere = self.sphere.center.abs().max_element() + self.sphere.radius;
        sphere.max(self.ray64.origin.abs().max_element())
    }

    /// Returns whether every correct formula in single precision agrees on whether the sphere is hit.
    pub fn is_clear(&self) -> bool {
        /// The least difference between the squares of the approach and of 1.
        const TANGENT_MARGIN: f64 = 0.01;
        /// The least difference between a distance and an end of the range, in radii.
        const END_MARGIN: f64 = 0.01;
        let distance = self.start();
        let squared = (self.approach * self.approach - 1.0).abs();
        if distance > FURTHEST_SIZES
            || squared < TANGENT_MARGIN.max(64.0 * EPSILON * distance * distance)
        {
            return false;
        }
        let margin = (END_MARGIN * self.sphere.radius).max(2.0 * self.distance_error());
        let ends = [self.ray64.min, self.ray64.max];
        let is_away = |root: f64| ends.iter().all(|end| (root - end).abs() >= margin);
        self.misses() || self.roots.into_iter().all(is_away)
    }

    /// Returns whether every correct formula in single precision computes the quantity of this name well
    /// within its tolerance.
    pub fn is_exact(&self, quantity: &str) -> bool {
        /// The largest part of a tolerance that errors may take.
        const PART: f64 = 0.3;
        let Some(distance) = self.hits().next() else {
            return true;
        };
        let coordinates = self.coordinates();
        let error = self.distance_error();
        let position = error + 2.0 * EPSILON * coordinates;
        let normal = position / self.sphere.radius;
        let from_pole = self.from_pole(distance);
        match quantity {
            "distance" => error <= PART * 1e-4 * coordinates.max(distance),
            "position" => position <= PART * 1e-4 * coordinates.max(distance),
            "normal" | "unit_normal" => normal <= PART * 1e-3,
            "uv" => from_pole > 0.012 && normal / from_pole <= PART * 2e-3,
            _ => true,
        }
    }
}

/// The relative error of one operation in single precision.
const EPSILON: f64 = 6e-8;

/// Draws a sphere with a radius of this class.
fn drawn_shape(rng: &mut Rng, size: usize) -> Shape {
    let radius = fields::size(rng, size);
    Shape::Sphere {
        center: fields::place(rng, radius).as_vec3(),
        radius: radius as f32,
        shape: fields::number(rng),
    }
}

/// Draws a ray in, around or beside a sphere. Returns `None` if it would start too far away.
fn ray(rng: &mut Rng, shape: &Shape) -> Option<Ray> {
    let bounds = scan::bounds(shape);
    let (center, radius) = (bounds.center(), 0.5 * (bounds.max - bounds.min).x);
    let dir = fields::direction(rng);
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

/// Draws a range that begins or ends just before or behind a root.
fn range_from_a_root(rng: &mut Rng, line: &Line) -> Option<Interval> {
    let beside = line.sphere.radius * rng.log_uniform(0.0101, 0.02);
    let end = (line.roots[rng.index(2)] + rng.sign() * beside) as f32;
    let range = if rng.coin() {
        Interval::new(end, f32::INFINITY)
    } else {
        Interval::new(0.0, end)
    };
    (end >= 0.0).then_some(range)
}

/// Draws spheres of these sizes, each with rays that belong to an idea, every other one a hit. All
/// correct formulas compute the judged quantities within their tolerances.
pub fn tables(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Line) -> bool,
) -> Vec<(Shape, Vec<Ray>)> {
    let is_fair = |line: &Line| line.is_clear() && judged.iter().all(|it| line.is_exact(it));
    let generator = Generator {
        domain: &SPHERE,
        subject: &drawn_shape,
        input: &ray,
        similar: &|call| similar(call, judged),
        fits: &|call| Line::of(call).is_some_and(|line| is_fair(&line) && belongs(&line)),
    };
    generator.tables(rng, sizes)
}

/// Returns a call whose answer differs in what is judged: another sphere is hit, or at another place.
fn similar(call: &ShapeCall, judged: &[&str]) -> ShapeCall {
    let Shape::Sphere { center, .. } = call.shape else {
        return *call;
    };
    if judged.contains(&"shape") {
        call.with_other_number()
    } else if judged.contains(&"position") {
        call.moved_to_origin(center)
    } else {
        call.smaller()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    /// The quadratic formula in full, in single precision.
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

    #[test]
    fn tangents_and_ends_of_ranges_are_not_clear() {
        let shape = Shape::Sphere {
            center: glam::vec3(0.0, 0.0, -5.0),
            radius: 1.0,
            shape: 0,
        };
        let is_clear = |x: f32, max: f32| {
            let ray = Ray::new(glam::vec3(x, 0.0, 0.0), glam::Vec3::NEG_Z).within(0.0, max);
            Line::of(&ShapeCall::new(shape, ray))
                .expect("a sphere")
                .is_clear()
        };
        assert!(is_clear(0.0, 9.0) && is_clear(0.9, 9.0) && is_clear(1.1, 9.0));
        assert!(!is_clear(0.999, 9.0) && !is_clear(1.001, 9.0));
        assert!(!is_clear(0.0, 4.005) && !is_clear(0.0, 6.005) && is_clear(0.0, 5.0));
    }
}
