// Computes the width of the sensor from the horizontal field of view, just as the height is
// computed from the vertical field of view.

use framework::math::{atan2, tan};

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let sensor = 2.0
            * Vec2::new(
                tan(0.5 * self.horizontal_fov()),
                tan(0.5 * self.vertical_fov.to_radians()),
            );
        let position = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(Vec3::ZERO, (position * sensor).extend(-1.0))
    }

    /// Returns the full angle from the leftmost ray to the rightmost, in radians.
    fn horizontal_fov(&self) -> f32 {
        let half_width = self.aspect_ratio * tan(0.5 * self.vertical_fov.to_radians());
        2.0 * atan2(half_width, 1.0)
    }
}
