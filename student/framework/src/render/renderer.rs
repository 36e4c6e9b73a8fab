//! The interface for anything that computes a picture sample by sample.

use std::time::Duration;

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::render::path_log;
use crate::render::path_steps::{BadPath, FirstBadValues};
use crate::scene::Scene;
use crate::submission::World;

/// The distance between the pixels whose first path is checked for bad values. Recording the steps
/// of every path would take too long.
const CHECKED_DISTANCE: u32 = 8;

/// Computes a picture sample by sample. Each sample only depends on its pixel and its number.
pub trait Renderer: Sync {
    /// Returns the radiance of one sample of a pixel.
    ///
    /// # Errors
    /// Fails if the submission returned an unusable hit, or if the radiance isn't finite.
    fn trace_sample(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample>;

    /// Returns the radiance of one sample of a pixel, or zero if it was discarded. The pixel's
    /// radiance is the mean of its samples, added in order.
    fn sample_radiance(&self, pixel: UVec2, sample: u32, stats: &mut RenderStats) -> Vec3 {
        let is_checked = sample == 0
            && (pixel % CHECKED_DISTANCE).cmpeq(UVec2::ZERO).all()
            && !path_log::is_following();
        let radiance = if is_checked {
            let (radiance, steps) = path_log::follow(|| self.trace_sample(pixel, sample, stats));
            stats.bad_values.add_path(pixel, &steps);
            radiance
        } else {
            self.trace_sample(pixel, sample, stats)
        };
        radiance.unwrap_or_else(|invalid| {
            match invalid {
                InvalidSample::Hit => stats.invalid_paths += 1,
                InvalidSample::Radiance => stats.invalid_radiances += 1,
            }
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PathSettings {
    /// The maximum number of times that a path is scattered: 0 shows only emitters and the
    /// environment, 1 adds direct light.
    pub bounces: u32,
    /// The seed for all random numbers.
    pub seed: u64,
}

/// The reason a sample is discarded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum InvalidSample {
    /// Its path contains an unusable hit from the submission, such as a hit that contains NaN.
    Hit,
    /// Its radiance is NaN or infinite.
    Radiance,
}

/// Statistics about the rendering of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RenderStats {
    /// The number of rays traced by the submission, including shadow rays.
    pub rays: u64,
    /// The number of discarded paths, which are treated as black because a hit contained NaN,
    /// infinity, a normal of length zero or an unknown shape.
    pub invalid_paths: u64,
    /// The number of paths that are treated as black because their radiance was NaN or infinite.
    pub invalid_radiances: u64,
    /// The first bad values in the paths that were checked.
    pub bad_values: FirstBadValues,
    /// The time spent in the submission's `Bvh::hit`. It is only measured if this is not `None`,
    /// because reading the clock twice per ray takes time, too.
    pub time_in_hit: Option<Duration>,
}

impl RenderStats {
    /// Adds the counts and bad values of another part of the picture.
    pub fn add(&mut self, part: &RenderStats) {
        self.rays += part.rays;
        self.invalid_paths += part.invalid_paths;
        self.invalid_radiances += part.invalid_radiances;
        for path in part.bad_values.paths() {
            self.bad_values.add(path);
        }
    }

    /// Returns a sentence about each kind of problem in the picture, without a full stop.
    pub fn notes(&self) -> Vec<String> {
        let black = |count: u64, why: &str| {
            let paths = if count == 1 { "path is" } else { "paths are" };
            (count > 0).then(|| format!("{count} {paths} black because {why}"))
        };
        let hits = black(
            self.invalid_paths,
            "a hit contains NaN or infinity, a normal of length zero, or an unknown shape",
        );
        let radiances = black(
            self.invalid_radiances,
            "`radiance` returned NaN or infinity",
        );
        let bad_values = self.bad_values.paths().map(|path| {
            let BadPath {
                kind,
                pixel: UVec2 { x, y },
                bounce,
            } = path;
            format!("at bounce {bounce} of the first path through pixel ({x}, {y}), {kind}")
        });
        hits.into_iter()
            .chain(radiances)
            .chain(bad_values)
            .collect()
    }
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
