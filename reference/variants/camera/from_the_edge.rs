// Measures from the left and lower edges of the sensor: −w/2 + fraction · w, axis by axis.

use framework::math::tan;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let height = 2.0 * tan(self.vertical_fov.to_radians() / 2.0);
        let width = self.aspect_ratio * height;
        let across = (pixel.x as f32 + offset.x) / self.film.x as f32;
        let up = (pixel.y as f32 + offset.y) / self.film.y as f32;

        let x = -width / 2.0 + across * width;
        let y = -height / 2.0 + up * height;
        Ray::new(Vec3::ZERO, Vec3::new(x, y, -1.0))
    }
}
