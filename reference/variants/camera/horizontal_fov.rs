//! Goes by way of the horizontal field of view: each side of the sensor from an angle of its own.

use framework::math::{atan2, tan};
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
        let sensor = 2.0
            * Vec2::new(
                tan(0.5 * self.horizontal_fov()),
                tan(0.5 * self.vertical_fov.to_radians()),
            );
        let place = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(Vec3::ZERO, (place * sensor).extend(-1.0))
    }

    /// The full angle between the leftmost and the rightmost ray, in radians.
    fn horizontal_fov(&self) -> f32 {
        let half_width = self.aspect_ratio * tan(0.5 * self.vertical_fov.to_radians());
        2.0 * atan2(half_width, 1.0)
    }
}
