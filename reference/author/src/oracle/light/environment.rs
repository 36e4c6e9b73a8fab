//! Environment maps: pictures of all directions, sampled by brightness.
//!
//! Directions are described by the longitude, from +x toward +z, and the latitude, from −π/2 at −y
//! to π/2 at +y. The top row of a map is around +y.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3, UVec2, Vec3, dvec2, dvec3};

use super::{WithMargin, luminance};

/// An environment map.
#[derive(Clone, Debug)]
pub struct Map64 {
    size: UVec2,
    /// The radiance of each pixel, row by row from the top.
    pixels: Vec<DVec3>,
    /// For each pixel, the probability that it is picked. All are zero for a black map.
    shares: Vec<f64>,
}

impl Map64 {
    /// Creates a map from its pixels, row by row from the top. There must be as many as `size` says.
    ///
    /// A pixel's weight is its luminance times the cosine of the latitude in the middle of its row.
    pub fn new(size: UVec2, pixels: &[Vec3]) -> Map64 {
        let pixels: Vec<DVec3> = pixels.iter().map(|pixel| pixel.as_dvec3()).collect();
        assert_eq!(pixels.len(), (size.x * size.y) as usize, "{size}");
        let weight = |(index, pixel): (usize, &DVec3)| {
            let row = (index / size.x as usize) as f64;
            let latitude = latitude((row + 0.5) / f64::from(size.y));
            luminance(*pixel) * libm::cos(latitude)
        };
        let weights: Vec<f64> = pixels.iter().enumerate().map(weight).collect();
        let total: f64 = weights.iter().sum();
        let share = |weight: f64| if total > 0.0 { weight / total } else { 0.0 };
        Map64 {
            size,
            pixels,
            shares: weights.into_iter().map(share).collect(),
        }
    }

    /// Returns the width and height in pixels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Returns the radiance of each pixel, row by row from the top.
    pub fn pixels(&self) -> &[DVec3] {
        &self.pixels
    }

    /// Returns the probability that each pixel is picked, row by row from the top.
    pub fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// Returns the index of the pixel that shows a direction. The margin is the distance from the
    /// pixel's border, as a fraction of a row or column, or 20 times the squared cosine of the
    /// latitude if that is less: near the poles, rounding changes this square the most.
    pub fn index(&self, direction: DVec3) -> WithMargin<usize> {
        let across = libm::hypot(direction.x, direction.z);
        let turns = libm::atan2(direction.z, direction.x) / TAU;
        let down = 0.5 - libm::atan2(direction.y, across) / PI;
        let size = self.size.as_dvec2();
        let position = dvec2(turns - libm::floor(turns), down) * size;
        let pixel = position.floor().min(size - 1.0);
        let inside = (position - pixel).min(pixel + 1.0 - position);
        WithMargin {
            value: (pixel.y * size.x + pixel.x) as usize,
            margin: inside.min_element().min(20.0 * across * across),
        }
    }

    /// Returns the radiance from a direction: that of the pixel which shows it.
    pub fn radiance(&self, direction: DVec3) -> WithMargin<DVec3> {
        let index = self.index(direction);
        index.and(self.pixels[index.value], f64::INFINITY)
    }

    /// Samples a direction. `choice` picks a pixel by its share, and `random` the position in the
    /// pixel, from its upper left corner. Returns `None` for a black map. The margin is the distance
    /// of `choice` from the nearest border between two pixels' shares.
    pub fn sample(&self, choice: f64, random: DVec2) -> WithMargin<Option<DVec3>> {
        let mut picked = None;
        let mut margin = f64::INFINITY;
        // The end of the shares before the pixel.
        let mut border = 0.0;
        for (index, &share) in self.shares.iter().enumerate() {
            if share == 0.0 {
                continue;
            }
            // Zero, where the first share starts, is not a border between two pixels.
            if picked.is_some() {
                margin = margin.min((choice - border).abs());
            }
            // Past the last border, the last pixel is picked, even if rounding makes the sum of all
            // shares less than `choice`.
            if picked.is_none() || border <= choice {
                picked = Some(index);
            }
            border += share;
        }
        let at = |index: usize| {
            let (row, column) = (index / self.size.x as usize, index % self.size.x as usize);
            self.direction(dvec2(column as f64, row as f64) + random)
        };
        WithMargin {
            value: picked.map(at),
            margin,
        }
    }

    /// Returns the probability density, per solid angle, with which [`Map64::sample`] chooses a
    /// direction: the pixel's share divided by the solid angle that the pixel would have if it were
    /// at the direction's own latitude everywhere. The margin is that of [`Map64::index`].
    pub fn pdf(&self, direction: DVec3) -> WithMargin<f64> {
        let index = self.index(direction);
        let size = self.size.as_dvec2();
        let (width, height) = (TAU / size.x, PI / size.y);
        let cosine = libm::hypot(direction.x, direction.z);
        let share = self.shares[index.value];
        let pdf = if share > 0.0 {
            share / (width * height * cosine)
        } else {
            0.0
        };
        index.and(pdf, f64::INFINITY)
    }

    /// Returns the direction at a position in pixels from the upper left corner of the map.
    fn direction(&self, position: DVec2) -> DVec3 {
        let fraction = position / self.size.as_dvec2();
        let (sin_longitude, cos_longitude) = libm::sincos(TAU * fraction.x);
        let (sin_latitude, cos_latitude) = libm::sincos(latitude(fraction.y));
        dvec3(
            cos_latitude * cos_longitude,
            sin_latitude,
            cos_latitude * sin_longitude,
        )
    }
}

/// Returns the latitude at a fraction of the map's height, from the top.
fn latitude(down: f64) -> f64 {
    FRAC_PI_2 - PI * down
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;
    use crate::oracle::light::grid;

    /// A map of 8 × 4 pixels. All are black except two that cover the same solid angle: the one in
    /// the second row is three times as bright as the one in the third row.
    fn two_pixels() -> Map64 {
        let mut pixels = vec![Vec3::ZERO; 32];
        pixels[8 + 1] = Vec3::splat(3.0);
        pixels[16 + 5] = Vec3::ONE;
        Map64::new(uvec2(8, 4), &pixels)
    }

    fn gradient() -> Map64 {
        let pixel = |n: u8| Vec3::new(f32::from(n), f32::from(n % 7), 1.0);
        Map64::new(uvec2(8, 4), &(0..32).map(pixel).collect::<Vec<Vec3>>())
    }

    #[test]
    fn the_density_integrates_to_one_over_all_directions() {
        for map in [two_pixels(), gradient()] {
            let side = 80;
            let densities = grid(side).map(|at| {
                let latitude = PI * (at.y - 0.5);
                let (sine, cosine) = libm::sincos(TAU * at.x);
                let across = libm::cos(latitude);
                let direction = dvec3(across * cosine, libm::sin(latitude), across * sine);
                // Near the poles, the same range of longitudes covers a smaller solid angle.
                map.pdf(direction).value * across
            });
            let total = densities.sum::<f64>() * TAU * PI / f64::from(side * side);
            assert!((total - 1.0).abs() < 1e-12, "{total}");
        }
    }

    #[test]
    fn samples_are_in_the_pixel_that_was_picked() {
        let map = gradient();
        let mut start = 0.0;
        for (index, share) in map.shares().iter().enumerate() {
            let sample = map.sample(start + 0.25 * share, dvec2(0.05, 0.4));
            let direction = sample.value.expect("the map is not black");
            assert!(direction.is_normalized());
            let found = map.index(direction);
            assert_eq!(found.value, index);
            assert!((found.margin - 0.05).abs() < 1e-9 && map.pdf(direction).value > 0.0);
            assert!(index == 0 || (sample.margin - 0.25 * share).abs() < 1e-12);
            start += share;
        }
    }

    #[test]
    fn samples_have_the_density_that_is_returned() {
        // The mean of radiance / pdf is the integral of the radiance.
        let map = gradient();
        let (side, choices) = (20, 500);
        let mut mean = 0.0;
        for choice in 0..choices {
            let choice = (f64::from(choice) + 0.5) / f64::from(choices);
            for random in grid(side) {
                let direction = map.sample(choice, random).value.unwrap();
                let quotient = map.radiance(direction).value.x / map.pdf(direction).value;
                mean += quotient / f64::from(choices * side * side);
            }
        }
        let band =
            |row: f64| libm::sin(latitude(row / 4.0)) - libm::sin(latitude(row / 4.0 + 0.25));
        let solid_angle = |index: usize| TAU / 8.0 * band((index / 8) as f64);
        let pixels = map.pixels.iter().enumerate();
        let expected: f64 = pixels
            .map(|(index, pixel)| pixel.x * solid_angle(index))
            .sum();
        assert!((mean / expected - 1.0).abs() < 2e-3, "{mean} {expected}");
    }

    #[test]
    fn values_match_hand_computed_values() {
        let map = two_pixels();
        let (sine, cosine) = libm::sincos(3.0 * PI / 8.0);
        let middle = dvec3(sine * cosine, cosine, sine * sine);
        let sample = map.sample(0.7, dvec2(0.5, 0.5));
        assert!(sample.value.unwrap().abs_diff_eq(middle, 1e-15));
        assert!((sample.margin - 0.05).abs() < 1e-15, "{}", sample.margin);
        let expected = 0.75 * 32.0 / (2.0 * PI * PI * sine);
        assert!((map.pdf(middle).value / expected - 1.0).abs() < 1e-14);
        assert_eq!(map.radiance(middle).value, DVec3::splat(3.0));
        assert_eq!(map.pdf(DVec3::X).value, 0.0);
        let upper = map.sample(0.8, dvec2(0.5, 0.5)).value.unwrap();
        assert_eq!(map.index(upper).value, 16 + 5);
    }

    #[test]
    fn a_black_map_is_never_sampled() {
        let map = Map64::new(uvec2(4, 2), &[Vec3::ZERO; 8]);
        assert_eq!(map.sample(0.5, dvec2(0.5, 0.5)).value, None);
        assert_eq!(map.pdf(DVec3::X).value, 0.0);
    }
}
