// Computes everything except the tangent in double precision.

use framework::math::tan;
use glam::DVec2;
use protocol::Interval;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let height = 2.0 * f64::from(tan(0.5 * self.vertical_fov.to_radians()));
        let sensor = DVec2::new(f64::from(self.aspect_ratio) * height, height);
        let position = (pixel.as_dvec2() + offset.as_dvec2()) / self.film.as_dvec2() - 0.5;
        let dir = (position * sensor).extend(-1.0).normalize();
        Ray {
            origin: Vec3::ZERO,
            dir: dir.as_vec3(),
            range: Interval::AHEAD,
        }
    }
}
