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
        // solution
        // starter: todo!("task 2: when is {ray:?} in the slab, within {times:?}?")
        let one = (self.min - ray.origin.x) / ray.dir.x;
        let other = (self.max - ray.origin.x) / ray.dir.x;
        let min = one.min(other).max(times.min);
        let max = one.max(other).min(times.max);
        (min <= max).then(|| Interval::new(min, max))
        // end solution
    }
}

/// Returns the nearest hit on any of the balls.
pub fn nearest(balls: &[Ball], ray: &Ray) -> Option<Trace> {
    // solution
    // starter: todo!("task 3: which of {} balls does {ray:?} hit first?", balls.len())
    let mut nearest = None;
    for ball in balls {
        nearest = Trace::nearer(nearest, ball.hit(ray));
    }
    nearest
    // end solution
}

/// Returns the center of a box.
pub fn center(min: Vec3, max: Vec3) -> Vec3 {
    (min + max) / 2.0
}
