//! Task 1: a ball.

// solution
// starter: use glam::Vec3;
use glam::{Vec2, Vec3};
// end solution
use protocol::{Ray, Trace};

/// A ball.
pub struct Ball {
    pub center: Vec3,
    pub radius: f32,
}

impl Ball {
    /// Returns the first point of the ball along the ray.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // solution
        // starter: todo!("task 1: where does {ray:?} hit the ball?")
        let to_center = self.center - ray.origin;
        let middle = to_center.dot(ray.dir);
        let half = (middle * middle - to_center.length_squared() + self.radius * self.radius).sqrt();
        let distance = middle - half;
        (distance >= 0.0).then(|| {
            let position = ray.at(distance);
            Trace {
                distance,
                position,
                normal: (position - self.center) / self.radius,
                uv: Vec2::ZERO,
                origin: ray.origin,
                shape: 0,
            }
        })
        // end solution
    }
}
