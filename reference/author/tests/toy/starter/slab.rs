//! Tasks 2 and 3: the space between two planes, and the nearest ball.

use glam::Vec3;
use protocol::{Interval, Ray, Trace};

use crate::ball::Ball;

/// The space between two planes that are perpendicular to the x axis.
pub struct Slab {
    pub min: f32,
    pub max: f32,
}

impl Slab {
    /// Returns the part of `times` in which the ray is in the slab.
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        todo!("task 2: when is {ray:?} in the slab, within {times:?}?")
    }
}

/// Returns the nearest hit on any of the balls.
pub fn nearest(balls: &[Ball], ray: &Ray) -> Option<Trace> {
    todo!("task 3: which of {} balls does {ray:?} hit first?", balls.len())
}

/// Returns the center of a box.
pub fn center(min: Vec3, max: Vec3) -> Vec3 {
    (min + max) / 2.0
}
