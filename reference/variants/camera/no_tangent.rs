// Moves the sensor to z = −cos(fov/2), where half of its height is sin(fov/2). This gives the same
// directions without a tangent.

use framework::math::sin_cos;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let (sin, cos) = sin_cos(0.5 * self.vertical_fov.to_radians());
        let half = Vec2::new(self.aspect_ratio * sin, sin);
        let position = (pixel.as_vec2() + offset) / (0.5 * self.film.as_vec2()) - 1.0;
        Ray::new(Vec3::ZERO, (position * half).extend(-cos))
    }
}
