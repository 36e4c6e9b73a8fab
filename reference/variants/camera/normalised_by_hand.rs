// Creates the ray without `Ray::new`, normalising the direction in this file.

use framework::math::tan;
use protocol::Interval;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let height = 2.0 * tan(0.5 * self.vertical_fov.to_radians());
        let width = self.aspect_ratio * height;
        let x = width * ((pixel.x as f32 + offset.x) / self.film.x as f32 - 0.5);
        let y = height * ((pixel.y as f32 + offset.y) / self.film.y as f32 - 0.5);
        let length = (x * x + y * y + 1.0).sqrt();
        Ray {
            origin: Vec3::ZERO,
            dir: Vec3::new(x / length, y / length, -1.0 / length),
            range: Interval::new(0.0, f32::INFINITY),
        }
    }
}
