//! Task 1: a ball.

use glam::Vec3;
use protocol::{Ray, Trace};

/// A ball.
pub struct Ball {
    pub center: Vec3,
    pub radius: f32,
}

impl Ball {
    /// Returns the first point of the ball along the ray.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        todo!("task 1: where does {ray:?} hit the ball?")
    }
}
