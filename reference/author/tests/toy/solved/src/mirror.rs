//! Tasks 2 and 3: a mirror, and the nearest ball.

use glam::Vec3;
use protocol::{Ray, Trace};

use crate::ball::Ball;

/// A mirror, in a coordinate frame whose +z axis is the mirror's normal.
pub struct Mirror;

impl Mirror {
    /// Returns the direction that is reflected toward the viewer.
    pub fn reflect(&self, toward_viewer: Vec3) -> Vec3 {
        // solution
        // starter: todo!("task 2: which direction is reflected toward {toward_viewer:?}?")
        Vec3::new(-toward_viewer.x, -toward_viewer.y, toward_viewer.z)
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
