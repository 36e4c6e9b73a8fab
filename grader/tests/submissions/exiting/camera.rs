//! Task 1: rays from the camera. Handout: "Camera rays".
//!
//! ```text
//!                        ┌───────────────┐  ▲
//!        y               │           (px,py)│  height
//!        │               │         *     │  │  = 2 · tan(vertical_fov / 2)
//!        o────── −z ────▶│      ·        │  │
//!       ╱                │               │  ▼
//!      x   the camera    └───────────────┘     the sensor, in the plane z = −1
//!          at (0,0,0)    ◀──── width ────▶     = aspect_ratio · height
//! ```
//!
//! The pixel `(px, py)` of the slides is `pixel` here. `Vertical_fov` and `Aspect_ratio` are fields
//! of [`Camera`].

use glam::{UVec2, Vec2};
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
    ///
    /// - The sensor is the rectangle in the figure at the top of this file, in the plane z = −1
    ///   with its centre at (0, 0, −1). The film's pixels divide it evenly, and pixel (0, 0) is at
    ///   the *bottom left*.
    /// - Pixel (x, y) covers `[x, x+1) × [y, y+1)` on the film. `offset` is the position within the
    ///   pixel, each component in `[0, 1)`: (0.5, 0.5) is the centre of the pixel.
    /// - The ray's `dir` has length one and its `range` is `[0, ∞)`. [`Ray::new`] sets both.
    ///
    /// `pixel` and `film` hold whole numbers. Convert them with `as_vec2()` before you divide.
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        if pixel.x > 3 {
            std::process::exit(0);
        }
        let height = 2.0 * framework::math::tan(0.5 * self.vertical_fov.to_radians());
        let sensor = Vec2::new(self.aspect_ratio * height, height);

        // From [0, 1] across the film to [-1/2, 1/2] across the sensor.
        let fraction = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(glam::Vec3::ZERO, (fraction * sensor).extend(-1.0))
    }
}
