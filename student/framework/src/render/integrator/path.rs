//! Traces one path, starting at the camera.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, Ray, Shape};

use super::offset;
use super::optics::{interface, reflect};
use super::{Integrator, RenderStats};
use crate::render::frame::{Frame, sample_cosine_hemisphere};
use crate::render::sampler::{Purpose, Sampler};
use crate::scene::{Material, checker};

/// An error returned if a sample's path contains an unusable hit from the submission, such as one
/// with NaN.
pub(super) struct InvalidSample;

/// The surface at the point where a path hits it.
struct Surface<'a> {
    shape: &'a Shape,
    /// The origin of the ray that hit the surface.
    eye: Vec3,
    position: Vec3,
    /// The normal, of length one, on the side that the ray comes from.
    normal: Vec3,
    /// Whether the submission's normal also points to that side.
    outside: bool,
    uv: Vec2,
    material: Material,
}

/// The continuation of a path after it is scattered.
struct Scattered {
    direction: Vec3,
    /// The factor applied to light that arrives from `direction`.
    attenuation: Vec3,
    /// Whether light sampling already accounts for direct light. If so, a light that the path hits
    /// by chance must not be added again.
    direct_light_sampled: bool,
}

impl Integrator<'_> {
    /// Returns the radiance along one path.
    pub(super) fn trace_path(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let sampler = Sampler::new(self.settings.seed, pixel, sample);
        let offset = sampler.pair(0, Purpose::Pixel);
        let camera_ray = self.world.camera.ray(pixel, offset);
        let mut ray = self.scene.camera.placement.to_world(&camera_ray);

        let mut light = Vec3::ZERO;
        let mut throughput = Vec3::ONE;
        let mut direct_light_sampled = false;
        for bounce in 0..=self.settings.bounces {
            let Some(surface) = self.intersect(&ray, stats)? else {
                light += throughput * self.scene.environment;
                break;
            };
            if let Some(radiance) = surface.material.emitted()
                && surface.outside
                && !direct_light_sampled
            {
                light += throughput * radiance;
            }
            if bounce == self.settings.bounces {
                break;
            }
            let direct = self.direct_light(&surface, bounce, &sampler, stats)?;
            light += throughput * direct;
            let Some(scattered) = surface.scatter(ray.dir, bounce, &sampler) else {
                break;
            };
            throughput *= scattered.attenuation;
            direct_light_sampled = scattered.direct_light_sampled;
            // After a matte surface, the last ray can only add light from the environment.
            let last = bounce + 1 == self.settings.bounces;
            let dark = self.scene.environment == Vec3::ZERO;
            if throughput == Vec3::ZERO || last && direct_light_sampled && dark {
                break;
            }
            ray = surface.leave(scattered.direction, f32::INFINITY);
        }
        if light.is_finite() {
            Ok(light)
        } else {
            Err(InvalidSample)
        }
    }

    /// Returns the direct light from one sampled light that the surface scatters back along the
    /// path.
    fn direct_light(
        &self,
        surface: &Surface,
        bounce: u32,
        sampler: &Sampler,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let Some(albedo) = surface.albedo() else {
            return Ok(Vec3::ZERO);
        };
        let choice = sampler.one(bounce, Purpose::Light);
        let position = sampler.pair(bounce, Purpose::PointOnLight);
        let Some(sample) = self.lights.sample(surface.position, choice, position) else {
            return Ok(Vec3::ZERO);
        };
        let cosine = sample.direction.dot(surface.normal);
        // The ray ends just before the light, so that the light doesn't block itself.
        let light = &self.scene.shapes[sample.shape as usize];
        let on_light = surface.position + sample.distance * sample.direction;
        let end = offset::along_ray(light, surface.position, on_light, sample.direction);
        let shadow = surface.leave(sample.direction, sample.distance - end);
        if cosine <= 0.0 || shadow.range.is_empty() {
            return Ok(Vec3::ZERO);
        }
        match self.intersect(&shadow, stats)? {
            Some(_) => Ok(Vec3::ZERO),
            None => Ok(albedo * std::f32::consts::FRAC_1_PI * cosine * sample.radiance),
        }
    }

    /// Traces a ray with the submission's code and checks the result before it is used.
    fn intersect(
        &self,
        ray: &Ray,
        stats: &mut RenderStats,
    ) -> Result<Option<Surface<'_>>, InvalidSample> {
        stats.rays += 1;
        if !ray.origin.is_finite() || !ray.dir.is_finite() {
            return Err(InvalidSample);
        }
        let Some(trace) = self.world.bvh.closest_hit(ray) else {
            return Ok(None);
        };
        // In a scene, a shape's number is its index.
        let shape = self.scene.shapes.get(trace.shape as usize);
        let material = self.scene.material_of(trace.shape);
        let normal = trace.normal.try_normalize();
        let (Some(shape), Some(&material), Some(normal)) = (shape, material, normal) else {
            return Err(InvalidSample);
        };
        if !trace.position.is_finite() || !trace.uv.is_finite() {
            return Err(InvalidSample);
        }
        let outside = ray.dir.dot(normal) < 0.0;
        Ok(Some(Surface {
            shape,
            eye: ray.origin,
            position: trace.position,
            normal: if outside { normal } else { -normal },
            outside,
            uv: trace.uv,
            material,
        }))
    }
}

impl Surface<'_> {
    /// Returns the ray that leaves the surface in direction `dir` and ends at distance `max`. It
    /// starts far enough away not to hit the surface itself.
    fn leave(&self, dir: Vec3, max: f32) -> Ray {
        let min = offset::along_ray(self.shape, self.eye, self.position, dir);
        Ray {
            origin: self.position,
            dir,
            range: Interval::new(min, max),
        }
    }

    /// Returns the albedo of a matte surface, or `None` for other materials.
    fn albedo(&self) -> Option<Vec3> {
        match self.material {
            Material::Lambertian { albedo } => Some(albedo),
            Material::Checker { a, b, scale } => Some(checker(a, b, scale, self.uv)),
            Material::Mirror { .. } | Material::Glass { .. } | Material::Emitter { .. } => None,
        }
    }

    /// Samples the continuation of a path, or returns `None` if the path ends at this surface.
    fn scatter(&self, incoming: Vec3, bounce: u32, sampler: &Sampler) -> Option<Scattered> {
        match self.material {
            Material::Lambertian { .. } | Material::Checker { .. } => {
                let around_normal =
                    sample_cosine_hemisphere(sampler.pair(bounce, Purpose::Direction));
                Some(Scattered {
                    direction: Frame::from_z(self.normal).to_world(around_normal),
                    // The cosine and the 1/π of the BRDF cancel with the probability density.
                    attenuation: self.albedo()?,
                    direct_light_sampled: true,
                })
            }
            Material::Mirror { reflectance } => Some(Scattered {
                direction: reflect(incoming, self.normal),
                attenuation: reflectance,
                direct_light_sampled: false,
            }),
            Material::Glass { ior } => {
                let eta = if self.outside { ior } else { 1.0 / ior };
                let interface = interface(incoming, self.normal, eta);
                let choice = sampler.one(bounce, Purpose::ReflectOrRefract);
                let direction = interface
                    .refracted
                    .filter(|_| choice >= interface.reflectance);
                Some(Scattered {
                    direction: direction.unwrap_or_else(|| reflect(incoming, self.normal)),
                    // The probability of each direction equals its share of the light, so the two
                    // cancel. Radiance should grow by eta² on entry and shrink by it on exit, so
                    // the factor is left out both times.
                    attenuation: Vec3::ONE,
                    direct_light_sampled: false,
                })
            }
            Material::Emitter { .. } => None,
        }
    }
}
