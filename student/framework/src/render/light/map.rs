//! Sampling of an environment map: brighter pixels are sampled more often.

use std::f32::consts::PI;

use glam::{UVec2, Vec2, Vec3, uvec2};

use super::LUMINANCE;
use crate::math::sin_cos;
use crate::scene::EnvironmentMap;

/// Samples the directions of a map in proportion to their luminance. See Pharr, Jakob and Humphreys,
/// "Physically Based Rendering", 4th edition, section 12.5.2.
pub(super) struct MapSampler {
    map: EnvironmentMap,
    /// For each pixel, row by row, the total weight of this pixel and all earlier pixels.
    cumulative: Vec<f64>,
}

impl MapSampler {
    pub(super) fn new(map: &EnvironmentMap) -> Self {
        let UVec2 {
            x: width,
            y: height,
        } = map.size();
        let mut total = 0.0;
        let cumulative = map.pixels().iter().enumerate().map(|(index, pixel)| {
            let row = index / width as usize;
            // Rows near the poles cover smaller solid angles.
            let (sine, _) = sin_cos(PI * (row as f32 + 0.5) / height as f32);
            total += f64::from(pixel.dot(LUMINANCE) * sine);
            total
        });
        MapSampler {
            cumulative: cumulative.collect(),
            map: map.clone(),
        }
    }

    /// Samples a direction. The random numbers `choice` and `position`, in `[0, 1)`, pick the pixel
    /// and the point within it. Also returns the radiance from that direction.
    pub(super) fn sample(&self, choice: f32, position: Vec2) -> (Vec3, Vec3) {
        let target = f64::from(choice) * self.total();
        let picked = self.cumulative.partition_point(|&sum| sum <= target);
        let picked = picked.min(self.cumulative.len() - 1) as u32;
        let width = self.map.size().x;
        let pixel = uvec2(picked % width, picked / width);
        let (direction, _) = self.map.direction(pixel.as_vec2() + position);
        (direction, self.map.pixel(pixel))
    }

    /// Returns the probability density, per solid angle, with which [`MapSampler::sample`] returns
    /// this direction, which must be a unit vector.
    pub(super) fn pdf(&self, direction: Vec3) -> f32 {
        let index = self.map.index(self.map.pixel_at(direction));
        let before = match index {
            0 => 0.0,
            _ => self.cumulative[index - 1],
        };
        let share = ((self.cumulative[index] - before) / self.total()) as f32;
        let sine = (1.0 - direction.y * direction.y).max(0.0).sqrt();
        if share == 0.0 || sine == 0.0 {
            return 0.0;
        }
        // A map covers 2π · π in the two angles.
        let pixels = self.map.size().as_vec2().element_product();
        share * pixels / (2.0 * PI * PI * sine)
    }

    fn total(&self) -> f64 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;
    use crate::render::sampler::{Purpose, Sampler};

    /// Returns a map with one bright pixel, some dim ones and a black row.
    fn sampler() -> MapSampler {
        let size = uvec2(16, 8);
        let pixels = (0..128).map(|index| match index {
            37 => Vec3::splat(100.0),
            48..64 => Vec3::ZERO,
            _ => Vec3::splat(0.1 + 0.01 * index as f32),
        });
        let map = EnvironmentMap::new(size, pixels.collect()).expect("the map is usable");
        MapSampler::new(&map)
    }

    #[test]
    fn the_density_integrates_to_one() {
        let sampler = sampler();
        let (width, height) = (640, 320);
        let cell = 2.0 * PI * PI / (width * height) as f32;
        let mut integral = 0.0;
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
            let position = vec2(x as f32 + 0.5, y as f32 + 0.5) / 40.0;
            let (direction, sine) = sampler.map.direction(position);
            integral += sampler.pdf(direction) * sine * cell;
        }
        assert!((integral - 1.0).abs() < 1e-3, "{integral}");
    }

    #[test]
    fn samples_estimate_the_mean_radiance() {
        let sampler = sampler();
        let count = 20_000;
        let mut mean = 0.0;
        for n in 0..count {
            let random = Sampler::new(0, UVec2::ZERO, n);
            let choice = random.one(0, Purpose::Light);
            let position = random.pair(0, Purpose::PointOnLight);
            let (direction, radiance) = sampler.sample(choice, position);
            mean += radiance.x / sampler.pdf(direction) / (4.0 * PI * count as f32);
        }
        // Each pixel's radiance times its share of the sphere.
        let expected: f32 = sampler
            .map
            .pixels()
            .iter()
            .enumerate()
            .map(|(index, pixel)| {
                let edge = |row: usize| sin_cos(PI * row as f32 / 8.0).1;
                let row = index / 16;
                pixel.x * (edge(row) - edge(row + 1)) / 32.0
            })
            .sum();
        assert!(
            (mean / expected - 1.0).abs() < 0.01,
            "{mean} instead of {expected}"
        );
    }

    #[test]
    fn black_pixels_are_never_sampled() {
        let sampler = sampler();
        for n in 0..1000 {
            let (direction, _) = sampler.sample(n as f32 / 1000.0, Vec2::splat(0.5));
            assert!(sampler.pdf(direction) > 0.0);
        }
        assert_eq!(sampler.pdf(sampler.map.direction(vec2(3.5, 3.5)).0), 0.0);
    }
}
