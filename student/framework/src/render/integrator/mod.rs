//! The path tracer, which renders a scene.
//!
//! The algorithm follows Kajiya, "The Rendering Equation", SIGGRAPH 1986, with light sampling at
//! each matte surface. Everything is computed in `f32` and in a fixed order, and each random number
//! depends only on its use (see [`sampler`](crate::render::sampler)). So a picture has the same
//! bytes on every machine and with any number of threads.

mod offset;
mod optics;
mod path;

use glam::{UVec2, Vec3};

use crate::render::light::Lights;
use crate::scene::Scene;
use crate::submission::{Submission, World};

/// The settings of a picture: its size, its quality and its seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderSettings {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// The number of paths per pixel.
    pub samples: u32,
    /// The maximum number of times that a path is scattered: 0 shows only emitters and the
    /// environment, 1 adds direct light.
    pub bounces: u32,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// Statistics of rendering a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// The number of rays traced by the submission, including shadow rays.
    pub rays: u64,
    /// The number of discarded paths, which are treated as black because a hit contained NaN,
    /// infinity, a normal of length zero or an unknown shape.
    pub invalid_paths: u64,
}

/// A path tracer for a scene that has been converted to a submission's own types.
pub struct Integrator<'a> {
    scene: &'a Scene,
    world: &'a World,
    lights: Lights,
    settings: RenderSettings,
}

impl<'a> Integrator<'a> {
    /// Creates a path tracer. `world` must be made from `scene`, and the film of `scene` must have
    /// the size `settings.film`.
    pub fn new(scene: &'a Scene, world: &'a World, settings: RenderSettings) -> Self {
        Integrator {
            scene,
            world,
            lights: Lights::of(scene),
            settings,
        }
    }

    /// Returns the mean radiance of all paths through a pixel.
    pub fn pixel_radiance(&self, pixel: UVec2, stats: &mut RenderStats) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for sample in 0..self.settings.samples {
            sum += self.sample_radiance(pixel, sample, stats);
        }
        sum / self.settings.samples.max(1) as f32
    }

    /// Returns the radiance of one path through a pixel, or zero if the path was discarded. The
    /// pixel's radiance is the mean of its samples, added in order.
    pub fn sample_radiance(&self, pixel: UVec2, sample: u32, stats: &mut RenderStats) -> Vec3 {
        self.trace_path(pixel, sample, stats)
            .unwrap_or_else(|path::InvalidSample| {
                stats.invalid_paths += 1;
                Vec3::ZERO
            })
    }
}

/// Renders a scene on the current thread. Returns linear red, green and blue, row by row from the
/// bottom.
pub fn render(submission: &dyn Submission, scene: &Scene, settings: &RenderSettings) -> Vec<Vec3> {
    let scene = scene.on_film(settings.film);
    let world = World::new(submission, &scene);
    let integrator = Integrator::new(&scene, &world, *settings);
    let mut stats = RenderStats::default();
    let rows = 0..settings.film.y;
    rows.flat_map(|y| (0..settings.film.x).map(move |x| UVec2::new(x, y)))
        .map(|pixel| integrator.pixel_radiance(pixel, &mut stats))
        .collect()
}

#[cfg(test)]
mod tests;
