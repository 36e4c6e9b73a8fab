// Scales normalised device coordinates, which run from −1 to 1 across the film, by half the width
// and half the height of the sensor.

use framework::math::tan;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let half_height = tan(0.5 * self.vertical_fov.to_radians());
        let half = Vec2::new(self.aspect_ratio * half_height, half_height);
        let device = 2.0 * (pixel.as_vec2() + offset) / self.film.as_vec2() - Vec2::ONE;
        Ray::new(Vec3::ZERO, (device * half).extend(-1.0))
    }
}
