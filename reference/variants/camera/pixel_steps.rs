// Goes from the lower left corner of the sensor in steps of one pixel. Shirley, Black and
// Hollasch, "Ray Tracing in One Weekend", section 4.2 ("Sending Rays Into the Scene"), start at
// the upper left.

use framework::math::tan;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let half_height = tan(0.5 * self.vertical_fov.to_radians());
        let half_width = self.aspect_ratio * half_height;
        let lower_left = Vec3::new(-half_width, -half_height, -1.0);
        let right = Vec3::X * (2.0 * half_width / self.film.x as f32);
        let up = Vec3::Y * (2.0 * half_height / self.film.y as f32);

        let steps = pixel.as_vec2() + offset;
        Ray::new(Vec3::ZERO, lower_left + steps.x * right + steps.y * up)
    }
}
