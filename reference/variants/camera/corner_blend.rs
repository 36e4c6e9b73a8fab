//! The sensor is known by its four corners; a place on it is their bilinear blend.

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
