//! The path tracer, which renders a scene.
//!
//! The algorithm follows Kajiya, "The Rendering Equation", SIGGRAPH 1986. At each matte surface,
//! the integrator combines samples of the lights with samples of the scattered directions.
//! Everything is computed in `f32` and in a fixed order, and each random number depends only on its
//! use (see [`sampler`](crate::render::sampler)). So a picture has the same bytes on every machine
//! and with any number of threads.

mod material;
mod path;

use crate::render::light::Lights;
use crate::render::tracer::Tracer;
use crate::scene::Scene;
use crate::submission::World;

/// The settings for tracing paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// The maximum number of times that a path is scattered: 0 shows only emitters and the
    /// environment, 1 adds direct light.
    pub bounces: u32,
    /// The seed for all random numbers.
    pub seed: u64,
}

/// A path tracer for a scene that has been converted to a submission's own types.
pub struct Integrator<'a> {
    tracer: Tracer<'a>,
    lights: Lights,
    settings: PathSettings,
}

impl<'a> Integrator<'a> {
    /// Creates a path tracer. `world` must be made from `scene`.
    pub fn new(scene: &'a Scene, world: &'a World, settings: PathSettings) -> Self {
        Integrator {
            tracer: Tracer { scene, world },
            lights: Lights::of(scene),
            settings,
        }
    }
}

#[cfg(test)]
mod tests;
