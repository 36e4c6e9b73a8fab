//! Measures from the left and lower edges of the sensor: −w/2 + fraction · w, axis by axis.

use framework::math::tan;
use glam::{UVec2, Vec2, Vec3};
use protocol::Ray;

/// A pinhole camera at the origin that looks down −z, with y up.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// The vertical field of view: the full angle from the lowest ray to the highest, in degrees.
    pub vertical_fov: f32,
    /// The width of the sensor divided by its height. It can differ from the shape of `film`.
    pub aspect_ratio: f32,
    /// The number of pixels, across and up.
    pub film: UVec2,
}

impl Camera {
    /// Creates a camera.
    pub fn new(vertical_fov: f32, aspect_ratio: f32, film: UVec2) -> Self {
        Camera {
            vertical_fov,
            aspect_ratio,
            film,
        }
    }

    /// Returns the ray that starts at the camera and passes through `pixel`.
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
