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

// starter: #[allow(unused_imports)] // You will need `Vec3`.
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
        // solution
        // starter: todo!("task 1, camera: which ray of {self:?} passes through {pixel} + {offset}?")
        let height = 2.0 * framework::math::tan(0.5 * self.vertical_fov.to_radians());
        let sensor = Vec2::new(self.aspect_ratio * height, height);

        // From [0, 1] across the film to [-1/2, 1/2] across the sensor.
        let fraction = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(Vec3::ZERO, (fraction * sensor).extend(-1.0))
        // end solution
    }
}

#[cfg(test)]
mod tests {
    use glam::{uvec2, vec2, vec3};

    use super::*;

    /// A camera whose sensor is 2 high (because tan 45° = 1) and 4 wide.
    fn wide_camera() -> Camera {
        Camera::new(90.0, 2.0, uvec2(8, 4))
    }

    #[track_caller]
    fn assert_dir(ray: Ray, expected: Vec3) {
        let got = ray.dir;
        assert!(
            got.abs_diff_eq(expected, 1e-5),
            "expected dir {expected}, got {got}"
        );
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_centre_of_the_film_is_straight_ahead() {
        let ray = wide_camera().sample_ray(uvec2(4, 2), vec2(0.0, 0.0));
        assert_eq!(
            ray.origin,
            Vec3::ZERO,
            "wrong origin: left is yours, right is correct"
        );
        assert_dir(ray, vec3(0.0, 0.0, -1.0));
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_first_pixel_starts_at_the_bottom_left_corner() {
        let ray = wide_camera().sample_ray(uvec2(0, 0), vec2(0.0, 0.0));
        let corner = vec3(-2.0, -1.0, -1.0);
        assert_dir(ray, corner.normalize());
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_offset_moves_within_the_pixel() {
        // Each pixel is 0.5 wide and 0.5 high on the sensor, so half a pixel is 0.25.
        let ray = wide_camera().sample_ray(uvec2(4, 2), vec2(0.5, 0.5));
        let on_sensor = vec3(0.25, 0.25, -1.0);
        assert_dir(ray, on_sensor.normalize());
    }
}
