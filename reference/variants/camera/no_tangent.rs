//! Pushes the sensor back to z = −cos(fov/2), where half its height is sin(fov/2): the same
//! directions, and no tangent.

use framework::math::sin_cos;
use glam::{UVec2, Vec2, Vec3};
use protocol::Ray;

/// A pinhole camera at the origin that looks down −z, with y up.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// The full angle between the lowest and the highest ray, in degrees.
    pub vertical_fov: f32,
    /// Width of the sensor divided by its height; need not be that of `film`.
    pub aspect_ratio: f32,
    /// Number of pixels, across and up.
    pub film: UVec2,
}

impl Camera {
    /// A camera from its parts.
    pub fn new(vertical_fov: f32, aspect_ratio: f32, film: UVec2) -> Self {
        Camera {
            vertical_fov,
            aspect_ratio,
            film,
        }
    }

    /// The ray that starts at the camera and passes through `pixel`.
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let (sin, cos) = sin_cos(0.5 * self.vertical_fov.to_radians());
        let half = Vec2::new(self.aspect_ratio * sin, sin);
        let place = (pixel.as_vec2() + offset) / (0.5 * self.film.as_vec2()) - 1.0;
        Ray::new(Vec3::ZERO, (place * half).extend(-cos))
    }
}
