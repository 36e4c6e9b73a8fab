// Computes a matrix from the film to the sensor once, in `new`. Pharr, Jakob and Humphreys,
// "Physically Based Rendering" (4th edition), section 5.2, call this matrix `cameraFromRaster`.

use framework::math::tan;
use glam::Mat3;

#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub vertical_fov: f32,
    pub aspect_ratio: f32,
    pub film: UVec2,
    /// The matrix that transforms (x, y, 1) on the film to the point on the sensor.
    sensor_from_film: Mat3,
}

impl Camera {
    pub fn new(vertical_fov: f32, aspect_ratio: f32, film: UVec2) -> Self {
        let half_height = tan(0.5 * vertical_fov.to_radians());
        let half = Vec2::new(aspect_ratio * half_height, half_height);
        let pixel = 2.0 * half / film.as_vec2();
        let sensor_from_film =
            Mat3::from_cols(Vec3::X * pixel.x, Vec3::Y * pixel.y, (-half).extend(-1.0));
        Camera {
            vertical_fov,
            aspect_ratio,
            film,
            sensor_from_film,
        }
    }

    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let on_film = (pixel.as_vec2() + offset).extend(1.0);
        Ray::new(Vec3::ZERO, self.sensor_from_film * on_film)
    }
}
