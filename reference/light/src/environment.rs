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

// starter: #[allow(unused_imports, reason = "your code will use them")]
use framework::math::{acos, atan2, sin_cos};
// starter: #[allow(unused_imports, reason = "your code will use it")]
use framework::render::film::luminance;
use framework::scene::EnvironmentMap;
use glam::{Vec2, Vec3, vec2};

/// Samples a direction uniformly from all directions, with two random numbers in `[0, 1)`. See PBR,
/// section A.5.1.
///
/// - The direction has length one.
/// - Any formula will do, as long as evenly distributed numbers give evenly distributed directions.
pub fn uniform_sphere(random: Vec2) -> Vec3 {
    // solution
    // starter: todo!("part two, environment: which direction belongs to {random:?}?")
    let height = 1.0 - 2.0 * random.x;
    let radius = (1.0 - height * height).max(0.0).sqrt();
    let (sin_phi, cos_phi) = sin_cos(TAU * random.y);
    Vec3::new(radius * cos_phi, height, radius * sin_phi)
    // end solution
}

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    // solution
    // starter: // Add your own fields here.
    /// For each pixel, row by row, the total weight of this pixel and all earlier pixels.
    cumulative: Vec<f64>,
    /// The total weight of all pixels.
    total: f64,
    // end solution
}

impl Environment {
    /// Prepares a map for sampling. See PBR, section 12.5.2.
    ///
    /// - A pixel's weight is its luminance, times the sine of θ in the middle of its row.
    /// - A map can be entirely black. In that case, [`Environment::sample`] is never called.
    pub fn new(map: EnvironmentMap) -> Self {
        // solution
        // starter: let size = map.size();
        // starter: todo!("part two, environment: what is the weight of each of {size} pixels?")
        let (width, height): (u32, u32) = map.size().into();
        let sines = (0..height).map(|row| sin_cos(PI * (row as f32 + 0.5) / height as f32).0);
        let rows = map.pixels().chunks(width as usize).zip(sines);
        let mut total = 0.0;
        let mut cumulative = Vec::with_capacity(map.pixels().len());
        for (row, sine) in rows {
            for pixel in row {
                total += f64::from(luminance(*pixel) * sine);
                cumulative.push(total);
            }
        }
        Environment {
            map,
            cumulative,
            total,
        }
        // end solution
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
        // solution
        // starter: todo!("part two, environment: which direction is {random:?} in pixel {choice}?")
        let target = f64::from(choice) * self.total;
        let picked = self.cumulative.partition_point(|&sum| sum <= target);
        let picked = picked.min(self.cumulative.len() - 1) as u32;
        let size = self.map.size();
        let pixel = vec2((picked % size.x) as f32, (picked / size.x) as f32);
        let position = (pixel + random) / size.as_vec2();
        let (sin_phi, cos_phi) = sin_cos(TAU * position.x);
        let (sin_theta, cos_theta) = sin_cos(PI * position.y);
        Vec3::new(sin_theta * cos_phi, cos_theta, sin_theta * sin_phi)
        // end solution
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
        // solution
        // starter: todo!("part two, environment: with what density does `sample` return {direction:?}?")
        let index = self.index(direction);
        let before = match index {
            0 => 0.0,
            _ => self.cumulative[index - 1],
        };
        let weight = self.cumulative[index] - before;
        let sine = (1.0 - direction.y * direction.y).max(0.0).sqrt();
        if weight == 0.0 || sine == 0.0 {
            return 0.0;
        }
        let share = (weight / self.total) as f32;
        let pixels = self.map.size().as_vec2().element_product();
        share * pixels / (2.0 * PI * PI * sine)
        // end solution
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

    // starter: #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_pixel_is_picked_by_its_share_of_the_weights() {
        let environment = two_pixels();
        for (choice, expected) in [(0.7, 8 + 1), (0.8, 16 + 5)] {
            let direction = environment.sample(choice, vec2(0.5, 0.5));
            let got = environment.index(direction);
            assert_eq!(got, expected, "the pixel at {direction}");
        }
    }

    // starter: #[ignore = "part two: run by `cargo examples`"]
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

    // starter: #[ignore = "part two: run by `cargo examples`"]
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

    // starter: #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn directions_have_length_one() {
        for random in [vec2(0.0, 0.0), vec2(0.3, 0.7), vec2(0.999, 0.999)] {
            let direction = uniform_sphere(random);
            assert!(direction.is_normalized(), "{random} gives {direction}");
        }
    }
}
