//! Walks from the lower left corner in steps of one pixel, as Shirley, Black and Hollasch, "Ray
//! Tracing in One Weekend", section 4.2 ("Sending Rays Into the Scene") does from the upper left.

use framework::math::tan;
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
        let half_height = tan(0.5 * self.vertical_fov.to_radians());
        let half_width = self.aspect_ratio * half_height;
        let lower_left = Vec3::new(-half_width, -half_height, -1.0);
        let right = Vec3::X * (2.0 * half_width / self.film.x as f32);
        let up = Vec3::Y * (2.0 * half_height / self.film.y as f32);

        let steps = pixel.as_vec2() + offset;
        Ray::new(Vec3::ZERO, lower_left + steps.x * right + steps.y * up)
    }
}
