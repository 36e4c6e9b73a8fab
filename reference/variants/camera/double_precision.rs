//! Computes everything except the tangent in double precision.

use framework::math::tan;
use glam::{DVec2, UVec2, Vec2, Vec3};
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
        let height = 2.0 * f64::from(tan(0.5 * self.vertical_fov.to_radians()));
        let sensor = DVec2::new(f64::from(self.aspect_ratio) * height, height);
        let position = (pixel.as_dvec2() + offset.as_dvec2()) / self.film.as_dvec2() - 0.5;
        let dir = (position * sensor).extend(-1.0).normalize();
        Ray {
            origin: Vec3::ZERO,
            dir: dir.as_vec3(),
            range: Interval::AHEAD,
        }
    }
}
