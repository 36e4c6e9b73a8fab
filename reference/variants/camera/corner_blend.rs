// Computes the four corners of the sensor and interpolates bilinearly between them.

use framework::math::tan;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let top = tan(self.vertical_fov.to_radians() / 2.0);
        let right = self.aspect_ratio * top;
        let bottom_left = Vec3::new(-right, -top, -1.0);
        let bottom_right = Vec3::new(right, -top, -1.0);
        let top_left = Vec3::new(-right, top, -1.0);
        let top_right = Vec3::new(right, top, -1.0);

        let part = (pixel.as_vec2() + offset) / self.film.as_vec2();
        let bottom = bottom_left.lerp(bottom_right, part.x);
        let top = top_left.lerp(top_right, part.x);
        Ray::new(Vec3::ZERO, bottom.lerp(top, part.y))
    }
}
