// Remembers the size of the last camera's sensor, so that the tangent is only computed once per
// picture. The size is only reused for a camera with the same angle and aspect ratio, so no ray
// depends on earlier calls.

use std::cell::Cell;

use framework::math::tan;

thread_local! {
    /// The field of view, the aspect ratio and the sensor of the last camera.
    static LAST: Cell<Option<(f32, f32, Vec2)>> = const { Cell::new(None) };
}

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let position = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(Vec3::ZERO, (position * self.sensor()).extend(-1.0))
    }

    fn sensor(&self) -> Vec2 {
        match LAST.get() {
            Some((fov, aspect, sensor))
                if fov == self.vertical_fov && aspect == self.aspect_ratio =>
            {
                sensor
            }
            _ => {
                let height = 2.0 * tan(0.5 * self.vertical_fov.to_radians());
                let sensor = Vec2::new(self.aspect_ratio * height, height);
                LAST.set(Some((self.vertical_fov, self.aspect_ratio, sensor)));
                sensor
            }
        }
    }
}
