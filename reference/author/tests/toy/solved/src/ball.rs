//! Task 1, solved.

use glam::{Vec2, Vec3};
use protocol::{Ray, Trace};

/// A ball.
pub struct Ball {
    pub center: Vec3,
    pub radius: f32,
}

impl Ball {
    /// Returns the first point of the ball along the ray.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
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
                material: 0,
            }
        })
    }
}
