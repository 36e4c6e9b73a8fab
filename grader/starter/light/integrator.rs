//! Given: connects your path tracer to the framework, which renders pictures with it.

use framework::render::renderer::{InvalidSample, Lighting, PathSettings, RenderStats, Renderer};
use framework::render::sampler::{Purpose, Sampler};
use framework::render::tracer::{SampleTracer, Tracer};
use framework::scene::Scene;
use framework::submission;
use glam::{UVec2, Vec3};

use crate::path::radiance;
use crate::world::{LightSources, World};

/// Your files, as an implementation of the framework's [`Lighting`].
pub struct Light;

/// A path tracer for one scene.
struct Integrator<'a> {
    tracer: Tracer<'a>,
    sources: LightSources,
    settings: PathSettings,
}

impl Lighting for Light {
    fn path_tracer<'a>(
        &self,
        scene: &'a Scene,
        world: &'a submission::World,
        settings: PathSettings,
    ) -> Box<dyn Renderer + 'a> {
        Box::new(Integrator {
            tracer: Tracer { scene, world },
            sources: LightSources::of(scene),
            settings,
        })
    }
}

impl Renderer for Integrator<'_> {
    fn trace_sample(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let sampler = Sampler::new(self.settings.seed, pixel, sample);
        let offset = sampler.pair(0, Purpose::Pixel);
        let ray = self.tracer.camera_ray(pixel, offset);
        let hits = SampleTracer::new(&self.tracer, stats);
        let world = World::new(&hits, &self.sources);
        let light = radiance(&world, ray, &sampler, self.settings.bounces);
        hits.finish(light)
    }
}
