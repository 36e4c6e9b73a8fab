//! Moves the sensor to z = −cos(fov/2), where half of its height is sin(fov/2): this gives the same
//! directions without a tangent.

use framework::math::sin_cos;
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
        let (sin, cos) = sin_cos(0.5 * self.vertical_fov.to_radians());
        let half = Vec2::new(self.aspect_ratio * sin, sin);
        let position = (pixel.as_vec2() + offset) / (0.5 * self.film.as_vec2()) - 1.0;
        Ray::new(Vec3::ZERO, (position * half).extend(-cos))
    }
}
