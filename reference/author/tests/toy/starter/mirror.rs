//! Tasks 2 and 3: a mirror, and the nearest ball.

use glam::Vec3;
use protocol::{Ray, Trace};

use crate::ball::Ball;

/// A mirror, in a coordinate frame whose +z axis is the mirror's normal.
pub struct Mirror;

impl Mirror {
    /// Returns the direction that is reflected toward the viewer.
    pub fn reflect(&self, toward_viewer: Vec3) -> Vec3 {
        todo!("task 2: which direction is reflected toward {toward_viewer:?}?")
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
