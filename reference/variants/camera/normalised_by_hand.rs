//! Creates the ray without `Ray::new`, normalising the direction in this file.

use framework::math::tan;
use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, Ray};

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
        let height = 2.0 * tan(0.5 * self.vertical_fov.to_radians());
        let width = self.aspect_ratio * height;
        let x = width * ((pixel.x as f32 + offset.x) / self.film.x as f32 - 0.5);
        let y = height * ((pixel.y as f32 + offset.y) / self.film.y as f32 - 0.5);
        let length = (x * x + y * y + 1.0).sqrt();
        Ray {
            origin: Vec3::ZERO,
            dir: Vec3::new(x / length, y / length, -1.0 / length),
            range: Interval::new(0.0, f32::INFINITY),
        }
    }
}
