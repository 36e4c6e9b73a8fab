use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::interval::Interval;

/// A ray: the points `origin + t * dir` for every `t` in `range`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// The point where the ray starts.
    pub origin: Vec3,
    /// The direction. It is a unit vector, so `t` is a distance.
    pub dir: Vec3,
    /// The distances from `origin` at which the ray can hit something. Both ends are included, and
    /// neither is negative.
    pub range: Interval,
}

impl Ray {
    /// Creates the ray from `origin` in the direction `dir`, with range `[0, ∞)`. `dir` may have
    /// any length except zero and is normalised.
    pub fn new(origin: Vec3, dir: Vec3) -> Self {
        Ray {
            origin,
            dir: dir.normalize(),
            range: Interval::AHEAD,
        }
    }

    /// Returns the same ray with the range from `min` to `max`.
    pub fn within(self, min: f32, max: f32) -> Self {
        Ray {
            range: Interval::new(min, max),
            ..self
        }
    }

    /// Returns the point at distance `t` from the origin.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.dir
    }
}

/// A hit: the point where a ray intersects a surface, and the surface's properties there.
///
/// There is no flag for "no hit": a miss is `None` in an `Option<Trace>`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// The distance from the ray's origin to the hit, along the ray.
    pub distance: f32,
    /// The point of the hit.
    pub position: Vec3,
    /// The surface normal at that point.
    pub normal: Vec3,
    /// The texture coordinates at that point.
    pub uv: Vec2,
    /// The origin of the ray.
    pub origin: Vec3,
    /// The number of the shape that was hit.
    pub shape: u32,
}

impl Trace {
    /// Returns the nearer of two hits. A miss counts as farther away than any hit.
    pub fn nearer(a: Option<Trace>, b: Option<Trace>) -> Option<Trace> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
            (hit, None) | (None, hit) => hit,
        }
    }
}
