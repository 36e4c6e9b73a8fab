//! Part two, step 6: light from an environment map, a picture of all directions.
//!
//! ```text
//!    φ = 0          columns         φ = 2π    θ is the angle from +y, and φ the angle around the
//!      ┌────────────────────────────┐ θ = 0   y-axis. The pixels of a row all cover the same solid
//!      │                            │         angle, but those near the poles cover less.
//!      │        ▓ the sun           │ rows
//!      │                            │         direction = (sin θ · cos φ, cos θ, sin θ · sin φ)
//!      └────────────────────────────┘ θ = π
//! ```

use std::f32::consts::{PI, TAU};

#[allow(unused_imports, reason = "your code will use them")]
use framework::math::{acos, atan2, sin_cos};
#[allow(unused_imports, reason = "your code will use it")]
use framework::render::film::luminance;
use framework::scene::EnvironmentMap;
use glam::{Vec2, Vec3, vec2};

/// Samples a direction uniformly from all directions, with two random numbers in `[0, 1)`. See PBR,
/// section A.5.1.
///
/// - The direction has length one.
/// - Any formula will do, as long as evenly distributed numbers give evenly distributed directions.
pub fn uniform_sphere(random: Vec2) -> Vec3 {
    todo!("part two, environment: which direction belongs to {random:?}?")
}

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    // Add your own fields here.
}

impl Environment {
    /// Prepares a map for sampling. See PBR, section 12.5.2.
    ///
    /// - A pixel's weight is its luminance, times the sine of θ in the middle of its row.
    /// - A map can be entirely black. In that case, [`Environment::sample`] is never called.
    pub fn new(map: EnvironmentMap) -> Self {
        let size = map.size();
        todo!("part two, environment: what is the weight of each of {size} pixels?")
    }

    /// Returns the radiance from a direction, which must be a unit vector. This is the radiance of
    /// the pixel that shows the direction.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.map.pixels()[self.index(direction)]
    }

    /// Returns the index of the pixel that shows a direction, which must be a unit vector.
    pub fn index(&self, direction: Vec3) -> usize {
        let phi = atan2(direction.z, direction.x).rem_euclid(TAU);
        let theta = acos(direction.y.clamp(-1.0, 1.0));
        let size = self.map.size();
        let position = vec2(phi / TAU, theta / PI) * size.as_vec2();
        // Because of rounding, the position can be on the map's far edge, past the last pixel.
        let pixel = position.as_uvec2().min(size - 1);
        (pixel.y * size.x + pixel.x) as usize
    }

    /// Samples a direction where the map is bright, with random numbers in `[0, 1)`.
    ///
    /// - `choice` picks the pixel: a pixel's share of `[0, 1)` is its share of the weights, row by
    ///   row from the top. Numbers at the border between two pixels are not tested.
    /// - `random` is the position in the pixel, from its upper left corner: `random.x` across and
    ///   `random.y` down. The result is the direction at this position, as a unit vector.
    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        todo!("part two, environment: which direction is {random:?} in pixel {choice}?")
    }

    /// Returns the probability density, per solid angle, with which [`Environment::sample`] chooses
    /// a direction: share · width · height / (2π² · sin θ). Here, `share` is the pixel's share of
    /// the weights, and θ is the angle of the direction itself, not that of the pixel's middle. The
    /// direction must be a unit vector.
    ///
    /// - The given [`Environment::index`] finds the pixel.
    /// - The result is zero for a black pixel, and everywhere if all pixels are black.
    /// - Directions close to a pole (sin θ < 0.03) and those at the edge of a pixel are not tested.
    pub fn pdf(&self, direction: Vec3) -> f32 {
        todo!("part two, environment: with what density does `sample` return {direction:?}?")
    }
}

#[cfg(test)]
mod tests {
    use glam::{uvec2, vec3};

    use super::*;

    /// A map of 8 × 4 pixels. All are black except two that cover the same solid angle: the one in
    /// the second row is three times as bright as the one in the third row.
    fn two_pixels() -> Environment {
        let mut pixels = vec![Vec3::ZERO; 32];
        pixels[8 + 1] = Vec3::splat(3.0);
        pixels[16 + 5] = Vec3::splat(1.0);
        let map = EnvironmentMap::new(uvec2(8, 4), pixels);
        Environment::new(map.expect("the map is usable"))
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_pixel_is_picked_by_its_share_of_the_weights() {
        let environment = two_pixels();
        for (choice, expected) in [(0.7, 8 + 1), (0.8, 16 + 5)] {
            let direction = environment.sample(choice, vec2(0.5, 0.5));
            let got = environment.index(direction);
            assert_eq!(got, expected, "the pixel at {direction}");
        }
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn the_middle_of_a_pixel_has_its_angles() {
        // θ = 3π/8 and φ = 3π/8.
        let (sin, cos) = sin_cos(3.0 * PI / 8.0);
        let expected = vec3(sin * cos, cos, sin * sin);
        let got = two_pixels().sample(0.5, vec2(0.5, 0.5));
        assert!(
            got.abs_diff_eq(expected, 1e-5),
            "expected {expected}, got {got}"
        );
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn the_density_is_the_share_of_a_pixel_over_its_solid_angle() {
        let (sin, cos) = sin_cos(3.0 * PI / 8.0);
        let direction = vec3(sin * cos, cos, sin * sin);
        let (got, expected) = (
            two_pixels().pdf(direction),
            0.75 * 32.0 / (2.0 * PI * PI * sin),
        );
        assert!(
            (got / expected - 1.0).abs() < 1e-4,
            "expected {expected}, got {got}"
        );
        assert_eq!(two_pixels().pdf(Vec3::X), 0.0, "a black pixel");
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn directions_have_length_one() {
        for random in [vec2(0.0, 0.0), vec2(0.3, 0.7), vec2(0.999, 0.999)] {
            let direction = uniform_sphere(random);
            assert!(direction.is_normalized(), "{random} gives {direction}");
        }
    }
}
