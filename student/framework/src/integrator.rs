//! From a scene to its light: path tracing.
//!
//! Kajiya, "The Rendering Equation", SIGGRAPH 1986, with lamps asked for directly at each matte
//! surface. Everything is in `f32` and in a fixed order, and each random number depends only on
//! what it is for (see [`sampler`](crate::sampler)): so a picture has the same bytes wherever and
//! by however many threads it is drawn.

mod optics;
mod path;

use glam::{UVec2, Vec3};

use crate::light::Lights;
use crate::scene::Scene;
use crate::submission::{Submission, World};

/// How much work to put into a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderSettings {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// Paths for each pixel.
    pub samples: u32,
    /// The most times that a path may be scattered: 0 shows only what shines by itself, 1 adds
    /// direct light.
    pub bounces: u32,
    /// What all random numbers follow from.
    pub seed: u64,
}

/// What was done for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Rays asked of the submission, shadow rays among them.
    pub rays: u64,
    /// Paths given up, and black, because an answer held NaN, infinity or an unknown material.
    pub invalid_paths: u64,
}

impl RenderStats {
    /// Both together.
    pub fn merge(self, other: RenderStats) -> RenderStats {
        RenderStats {
            rays: self.rays + other.rays,
            invalid_paths: self.invalid_paths + other.invalid_paths,
        }
    }
}

/// A scene, and a submission's view of it, ready for paths.
pub struct Integrator<'a> {
    scene: &'a Scene,
    world: &'a World,
    lights: Lights,
    sampling: RenderSettings,
    /// No ray counts before this distance: see [`Integrator::new`].
    epsilon: f32,
}

impl<'a> Integrator<'a> {
    /// `world` is the submission's own of `scene`, which is on a film of `sampling.film`.
    ///
    /// A ray that leaves a surface must not meet it again where it starts. An `f32` carries 24
    /// bits, so a position is known to 6e-8 of the scene's largest coordinate, and the formulas
    /// for triangles and spheres lose some hundred times as much where the ray grazes. 1e-4 of
    /// that coordinate stays clear of it, and is less than a picture can show.
    pub fn new(scene: &'a Scene, world: &'a World, sampling: RenderSettings) -> Self {
        Integrator {
            scene,
            world,
            lights: Lights::of(scene),
            sampling,
            epsilon: 1e-4 * scene.extent(),
        }
    }

    /// Positions less than this apart are the same to an `f32`.
    #[cfg(feature = "cli")]
    pub(crate) fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// The mean of all paths through a pixel.
    pub fn pixel_radiance(&self, pixel: UVec2, tally: &mut RenderStats) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for sample in 0..self.sampling.samples {
            match self.trace_path(pixel, sample, tally) {
                Ok(light) => sum += light,
                Err(path::InvalidSample) => tally.invalid_paths += 1,
            }
        }
        sum / self.sampling.samples.max(1) as f32
    }
}

/// The picture of a scene, in linear red, green and blue, row by row from the bottom, drawn by
/// this thread alone.
pub fn render(submission: &dyn Submission, scene: &Scene, sampling: &RenderSettings) -> Vec<Vec3> {
    let scene = scene.on_film(sampling.film);
    let world = World::new(submission, &scene);
    let integrator = Integrator::new(&scene, &world, *sampling);
    let mut tally = RenderStats::default();
    let rows = 0..sampling.film.y;
    rows.flat_map(|y| (0..sampling.film.x).map(move |x| UVec2::new(x, y)))
        .map(|pixel| integrator.pixel_radiance(pixel, &mut tally))
        .collect()
}

#[cfg(test)]
mod tests;

// Former names, so that submissions written before they changed still compile.
#[doc(hidden)]
pub use self::{RenderSettings as Sampling, RenderStats as Tally, render as radiance};
