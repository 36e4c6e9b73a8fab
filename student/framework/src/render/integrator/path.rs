//! Traces one path, starting at the camera.

use glam::{UVec2, Vec3};
use protocol::Ray;

use super::Integrator;
use super::material::{Glass, Lambertian, Mirror, Scattered};
use crate::render::frame::Frame;
use crate::render::light::{LightSample, LightSource};
use crate::render::offset;
use crate::render::renderer::{InvalidSample, RenderStats, Renderer};
use crate::render::sampler::{Purpose, RandomNumbers, Sampler};
use crate::render::tracer::Surface;
use crate::scene::{Material, checker};

/// The first bounce after which a path may end by chance.
const ROULETTE_START: u32 = 3;

/// The limits of the probability that a path survives.
const SURVIVAL: (f32, f32) = (0.05, 0.95);

impl Renderer for Integrator<'_> {
    /// Returns the radiance along one path.
    fn trace_sample(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let sampler = Sampler::new(self.settings.seed, pixel, sample);
        let offset = sampler.pair(0, Purpose::Pixel);
        let mut ray = self.tracer.camera_ray(pixel, offset);
        let mut light = Vec3::ZERO;
        let mut throughput = Vec3::ONE;
        // Where the path was last scattered by a matte surface, and the probability density of the
        // direction. `None` after the camera, a mirror or glass.
        let mut from: Option<(Vec3, f32)> = None;
        for bounce in 0..=self.settings.bounces {
            let Some(surface) = self.tracer.intersect(&ray, stats)? else {
                let weight = self.weight(from, LightSource::Environment, &ray, f32::INFINITY);
                light += throughput * weight * self.tracer.scene.environment.radiance(ray.dir);
                break;
            };
            let material = self.material(&surface)?;
            if let Some(radiance) = material.emitted().filter(|_| surface.outside) {
                let source = LightSource::Shape(surface.shape.number());
                let distance = surface.eye.distance(surface.position);
                light += throughput * self.weight(from, source, &ray, distance) * radiance;
            }
            if bounce == self.settings.bounces {
                break;
            }
            let numbers = sampler.numbers(bounce);
            let frame = frame(material, &surface);
            let matte = matte(material, &surface);
            if let Some(matte) = matte {
                light += throughput * self.direct_light(&surface, frame, matte, &numbers, stats)?;
            }
            let Some(scattered) = scatter(material, matte, &numbers, frame.to_local(surface.out))
            else {
                break;
            };
            throughput *= scattered.attenuation;
            if bounce >= ROULETTE_START {
                let survival = throughput.max_element().clamp(SURVIVAL.0, SURVIVAL.1);
                if numbers.survive >= survival {
                    break;
                }
                throughput /= survival;
            }
            if throughput == Vec3::ZERO {
                break;
            }
            ray = surface.leave(frame.to_world(scattered.direction), f32::INFINITY);
            from = scattered.pdf.map(|pdf| (surface.position, pdf));
        }
        if light.is_finite() {
            Ok(light)
        } else {
            Err(InvalidSample)
        }
    }
}

impl Integrator<'_> {
    /// Returns the material of a surface.
    fn material(&self, surface: &Surface) -> Result<&Material, InvalidSample> {
        let material = self.tracer.scene.material_of(surface.shape.number());
        material.ok_or(InvalidSample)
    }

    /// Returns the direct light from one sampled light that a matte surface scatters back along the
    /// path.
    ///
    /// The path itself can also reach this light by chance. So there are two samples of the light,
    /// and each is divided by the sum of both densities: the balance heuristic. The light sample
    /// dominates where a light is small or far away, and the scattering sample where the light is
    /// large or close. See Veach and Guibas, "Optimally Combining Sampling Techniques for Monte
    /// Carlo Rendering", SIGGRAPH 1995, section 3.2.
    fn direct_light(
        &self,
        surface: &Surface,
        frame: Frame,
        matte: Lambertian,
        numbers: &RandomNumbers,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let from = surface.position;
        let Some(sample) = self.lights.sample(from, numbers.light, numbers.on_light) else {
            return Ok(Vec3::ZERO);
        };
        let LightSample {
            source,
            direction,
            distance,
            radiance,
        } = sample;
        let (out, incoming) = (frame.to_local(surface.out), frame.to_local(direction));
        let shadow = surface.leave(direction, distance - self.margin(&sample, from));
        let value = matte.evaluate(out, incoming);
        if value == Vec3::ZERO || shadow.range.is_empty() {
            return Ok(Vec3::ZERO);
        }
        if self.tracer.intersect(&shadow, stats)?.is_some() {
            return Ok(Vec3::ZERO);
        }
        let light_pdf = self.lights.pdf(source, from, direction, distance);
        Ok(value * radiance / (light_pdf + matte.pdf(out, incoming)))
    }

    /// Returns how far short of a light a ray toward it must end, so that the light doesn't block
    /// itself.
    fn margin(&self, sample: &LightSample, from: Vec3) -> f32 {
        let LightSource::Shape(index) = sample.source else {
            return 0.0;
        };
        let shape = &self.tracer.scene.shapes[index as usize];
        let on_light = from + sample.distance * sample.direction;
        offset::along_ray(shape, from, on_light, sample.direction)
    }

    /// Returns the weight, from 0 to 1, of light that a path reaches by chance. The rest of that
    /// light was added by [`Integrator::direct_light`].
    fn weight(
        &self,
        from: Option<(Vec3, f32)>,
        source: LightSource,
        ray: &Ray,
        distance: f32,
    ) -> f32 {
        from.map_or(1.0, |(position, pdf)| {
            pdf / (pdf + self.lights.pdf(source, position, ray.dir, distance))
        })
    }
}

/// Returns how a matte surface scatters, or `None` for other materials.
fn matte(material: &Material, surface: &Surface) -> Option<Lambertian> {
    let albedo = match *material {
        Material::Lambertian { albedo } => albedo,
        Material::Checker { a, b, scale } => checker(a, b, scale, surface.uv),
        Material::Mirror { .. } | Material::Glass { .. } | Material::Emitter { .. } => return None,
    };
    Some(Lambertian { albedo })
}

/// Returns the frame of a surface, oriented as its material expects.
fn frame(material: &Material, surface: &Surface) -> Frame {
    let is_inside_glass = matches!(material, Material::Glass { .. }) && !surface.outside;
    Frame::from_z(if is_inside_glass {
        -surface.normal
    } else {
        surface.normal
    })
}

/// Samples the continuation of a path, in the surface's frame. Returns `None` if the path ends at
/// the surface.
fn scatter(
    material: &Material,
    matte: Option<Lambertian>,
    numbers: &RandomNumbers,
    out: Vec3,
) -> Option<Scattered> {
    match *material {
        Material::Lambertian { .. } | Material::Checker { .. } => {
            matte.map(|matte| matte.scatter(out, numbers.scatter))
        }
        Material::Mirror { reflectance } => Some(Mirror { reflectance }.scatter(out)),
        Material::Glass { ior } => Some(Glass { ior }.scatter(out, numbers.reflect)),
        Material::Emitter { .. } => None,
    }
}
