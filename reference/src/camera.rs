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
        // solution
        // starter: todo!("task 1, camera: which ray of {self:?} passes through {pixel} + {offset}?")
        let height = 2.0 * framework::math::tan(0.5 * self.vertical_fov.to_radians());
        let sensor = Vec2::new(self.aspect_ratio * height, height);

        // From [0, 1] across the film to [-1/2, 1/2] across the sensor.
        let place = (pixel.as_vec2() + offset) / self.film.as_vec2() - 0.5;
        Ray::new(glam::Vec3::ZERO, (place * sensor).extend(-1.0))
        // end solution
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, uvec2, vec2, vec3};

    use super::*;

    /// A sensor 2 high (tan 45° = 1) and 4 wide.
    fn wide() -> Camera {
        Camera::new(90.0, 2.0, uvec2(8, 4))
    }

    #[track_caller]
    fn assert_dir(ray: Ray, wanted: Vec3) {
        let got = ray.dir;
        assert!(
            got.abs_diff_eq(wanted, 1e-5),
            "dir is {got}, wanted {wanted}"
        );
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_centre_of_the_film_is_straight_ahead() {
        let ray = wide().sample_ray(uvec2(4, 2), vec2(0.0, 0.0));
        assert_eq!(ray.origin, Vec3::ZERO);
        assert_dir(ray, vec3(0.0, 0.0, -1.0));
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_first_pixel_starts_at_the_bottom_left_corner() {
        let ray = wide().sample_ray(uvec2(0, 0), vec2(0.0, 0.0));
        let corner = vec3(-2.0, -1.0, -1.0);
        assert_dir(ray, corner.normalize());
    }

    // starter: #[ignore = "task 1: not written yet"]
    #[test]
    fn the_offset_moves_within_the_pixel() {
        // Half a pixel is 1/4 of the sensor's plane, across and up.
        let ray = wide().sample_ray(uvec2(4, 2), vec2(0.5, 0.5));
        let place = vec3(0.25, 0.25, -1.0);
        assert_dir(ray, place.normalize());
    }
}
