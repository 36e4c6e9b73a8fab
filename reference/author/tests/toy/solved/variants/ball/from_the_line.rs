// Measures how far the centre is from the ray's line, which gives half of the chord.

use glam::{Vec2, Vec3};

impl Ball {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let along = (self.center - ray.origin).dot(ray.dir);
        let foot = ray.origin + along * ray.dir;
        let half_squared = self.radius.powi(2) - foot.distance_squared(self.center);
        let distance = along - half_squared.sqrt();
        if half_squared < 0.0 || distance < 0.0 {
            return None;
        }
        let position = ray.at(distance);
        Some(Trace {
            distance,
            position,
            normal: (position - self.center).normalize(),
            uv: Vec2::ZERO,
            origin: ray.origin,
            shape: 0,
        })
    }
}
