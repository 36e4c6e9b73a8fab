use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::interval::Interval;

/// A ray: the points `origin + t * dir` for every `t` in `range`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// The point where the ray starts.
    pub origin: Vec3,
    /// The direction, of length one, so that `t` is a distance.
    pub dir: Vec3,
    /// The distances from `origin` where the ray can hit something. Both ends are included, and
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
