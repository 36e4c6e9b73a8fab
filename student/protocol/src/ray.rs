use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::interval::Interval;

/// The points `origin + t * dir` for every `t` in `range`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it goes; of length one, so that `t` is a distance.
    pub dir: Vec3,
    /// The part of the ray that counts, as distances from `origin`; both ends included.
    pub range: Interval,
}

impl Ray {
    /// The ray from `origin` toward `dir`, of any length but zero, with range `[0, ∞)`.
    pub fn new(origin: Vec3, dir: Vec3) -> Self {
        Ray {
            origin,
            dir: dir.normalize(),
            range: Interval::AHEAD,
        }
    }

    /// The same ray, of which only `range` counts.
    pub fn within(self, min: f32, max: f32) -> Self {
        Ray {
            range: Interval::new(min, max),
            ..self
        }
    }

    /// The point at distance `t` from the origin.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.dir
    }
}
