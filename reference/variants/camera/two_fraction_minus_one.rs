//! Scales normalised device coordinates, which run from −1 to 1 across the film, by half the width
//! and half the height of the sensor.

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
        let half_height = tan(0.5 * self.vertical_fov.to_radians());
        let half = Vec2::new(self.aspect_ratio * half_height, half_height);
        let device = 2.0 * (pixel.as_vec2() + offset) / self.film.as_vec2() - Vec2::ONE;
        Ray::new(Vec3::ZERO, (device * half).extend(-1.0))
    }
}
