//! The interface for anything that computes a picture sample by sample.

use std::time::Duration;

use glam::{UVec2, Vec3};

use crate::scene::Scene;
use crate::submission::World;

/// Computes a picture sample by sample. Each sample only depends on its pixel and its number.
pub trait Renderer: Sync {
    /// Returns the radiance of one sample of a pixel.
    ///
    /// # Errors
    /// Fails if the submission returned an unusable hit.
    fn trace_sample(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample>;

    /// Returns the radiance of one sample of a pixel, or zero if it was discarded. The pixel's
    /// radiance is the mean of its samples, added in order.
    fn sample_radiance(&self, pixel: UVec2, sample: u32, stats: &mut RenderStats) -> Vec3 {
        let radiance = self.trace_sample(pixel, sample, stats);
        radiance.unwrap_or_else(|InvalidSample| {
            stats.invalid_paths += 1;
            Vec3::ZERO
        })
    }

    /// Returns the mean radiance of this many samples of a pixel.
    fn pixel_radiance(&self, pixel: UVec2, samples: u32, stats: &mut RenderStats) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for sample in 0..samples {
            sum += self.sample_radiance(pixel, sample, stats);
        }
        sum / samples.max(1) as f32
    }
}

/// Part two's code, which computes the light in a picture.
pub trait Lighting: Sync {
    /// Creates a path tracer. `world` must be made from `scene`.
    fn path_tracer<'a>(
        &self,
        scene: &'a Scene,
        world: &'a World,
        settings: PathSettings,
    ) -> Box<dyn Renderer + 'a>;
}

/// The settings for tracing paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// The maximum number of times that a path is scattered: 0 shows only emitters and the
    /// environment, 1 adds direct light.
    pub bounces: u32,
    /// The seed for all random numbers.
    pub seed: u64,
}

/// An error returned if a sample's path contains an unusable hit from the submission, such as a hit
/// that contains NaN.
#[derive(Clone, Copy, Debug)]
pub struct InvalidSample;

/// Statistics about the rendering of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// The number of rays traced by the submission, including shadow rays.
    pub rays: u64,
    /// The number of discarded paths, which are treated as black because a hit contained NaN,
    /// infinity, a normal of length zero or an unknown shape.
    pub invalid_paths: u64,
    /// The time spent in the submission's `Bvh::hit`. It is only measured if this is not `None`,
    /// because reading the clock twice per ray takes time, too.
    pub time_in_hit: Option<Duration>,
}

/// Renders a picture on the current thread. Returns linear red, green and blue, row by row from the
/// bottom.
pub fn render(renderer: &dyn Renderer, film: UVec2, samples: u32) -> Vec<Vec3> {
    let mut stats = RenderStats::default();
    let rows = 0..film.y;
    rows.flat_map(|y| (0..film.x).map(move |x| UVec2::new(x, y)))
        .map(|pixel| renderer.pixel_radiance(pixel, samples, &mut stats))
        .collect()
}
