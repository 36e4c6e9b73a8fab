//! Computes the four corners of the sensor, and a point on the sensor by bilinear interpolation
//! between them.

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
