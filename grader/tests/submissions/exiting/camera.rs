//! Task 1: rays from the camera. Handout: "Camera rays".
//!
//! ```text
//!                        ┌───────────────┐  ▲
//!        y               │           (px,py)│  height
//!        │               │         *     │  │  = 2 · tan(vertical_fov / 2)
//!        o────── −z ────▶│      ·        │  │
//!       ╱                │               │  ▼
//!      x   the camera    └───────────────┘     the sensor plane, z = −1
//!          at (0,0,0)    ◀──── width ────▶     = aspect_ratio · height
//! ```

use glam::{UVec2, Vec2};
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
    ///
    /// - The sensor is the rectangle at z = −1 around (0, 0, −1) of the height and width drawn
    ///   above. The film's pixels divide it evenly; pixel (0, 0) is at the *bottom left*.
    /// - Pixel (x, y) covers `[x, x+1) × [y, y+1)` of the film, and `offset`, each component in
    ///   `[0, 1)`, is the place in it: (0.5, 0.5) is its middle.
    /// - The ray's `dir` has length one and its `range` is `[0, ∞)`, as [`Ray::new`] makes them.
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        if pixel.x > 3 {
            std::process::exit(0);
        }
        let height = 2.0 * framework::math::tan(0.5 * self.vertical_fov.to_radians());
        let sensor = Vec2::new(self.aspect_ratio * height, height);

        // From [0, 1] across the film to [-1/2, 1/2] across the sensor.
        let place = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(glam::Vec3::ZERO, (place * sensor).extend(-1.0))
    }
}
