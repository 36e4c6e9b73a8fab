//! One path, from the camera until it is lost.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, Ray};

use super::optics::{interface, reflect};
use super::{Integrator, RenderStats};
use crate::frame::{Frame, sample_cosine_hemisphere};
use crate::sampler::{Purpose, Sampler};
use crate::scene::{Material, checker};

/// An answer that no light can be computed from.
pub(super) struct InvalidSample;

/// Where a path meets something.
struct Surface {
    position: Vec3,
    /// Of length one, on the side that the ray comes from.
    normal: Vec3,
    /// Whether that is the side that the submission's normal points to.
    outside: bool,
    uv: Vec2,
    material: Material,
}

/// How a path goes on.
struct Scattered {
    direction: Vec3,
    /// What the light from there is worth here.
    weight: Vec3,
    /// Whether lamps were asked for already, so that meeting one by chance must not count.
    direct_light_sampled: bool,
}

impl Integrator<'_> {
    /// The light that one path brings.
    pub(super) fn trace_path(
        &self,
        pixel: UVec2,
        sample: u32,
        tally: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let sampler = Sampler::new(self.sampling.seed, pixel, sample);
        let offset = sampler.pair(0, Purpose::Pixel);
        let camera_ray = self.world.camera_ray(pixel, offset);
        let mut ray = self.scene.camera.placement.to_world(&camera_ray);

        let mut light = Vec3::ZERO;
        let mut weight = Vec3::ONE;
        let mut lamps_asked = false;
        for bounce in 0..=self.sampling.bounces {
            let Some(surface) = self.intersect(&ray, tally)? else {
                light += weight * self.scene.environment;
                break;
            };
            if let Some(radiance) = surface.material.emitted()
                && surface.outside
                && !lamps_asked
            {
                light += weight * radiance;
            }
            if bounce == self.sampling.bounces {
                break;
            }
            let direct = self.direct_light(&surface, bounce, &sampler, tally)?;
            light += weight * direct;
            let Some(scattered) = surface.scatter(ray.dir, bounce, &sampler) else {
                break;
            };
            weight *= scattered.weight;
            lamps_asked = scattered.direct_light_sampled;
            // The last ray after a matte surface could only bring light from around.
            let last = bounce + 1 == self.sampling.bounces;
            if weight == Vec3::ZERO || last && lamps_asked && self.scene.environment == Vec3::ZERO {
                break;
            }
            ray = self.ray_from(&surface, scattered.direction, f32::INFINITY);
        }
        if light.is_finite() {
            Ok(light)
        } else {
            Err(InvalidSample)
        }
    }

    /// The light that comes straight from a lamp, and is scattered toward where the path comes
    /// from.
    fn direct_light(
        &self,
        surface: &Surface,
        bounce: u32,
        sampler: &Sampler,
        tally: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let Some(albedo) = surface.albedo() else {
            return Ok(Vec3::ZERO);
        };
        let choice = sampler.one(bounce, Purpose::Light);
        let place = sampler.pair(bounce, Purpose::PointOnLight);
        let Some(lit) = self.lights.sample(surface.position, choice, place) else {
            return Ok(Vec3::ZERO);
        };
        let cosine = lit.direction.dot(surface.normal);
        // The ray ends short of the lamp, which would else hide itself.
        let shadow = self.ray_from(surface, lit.direction, lit.distance - self.epsilon);
        if cosine <= 0.0 || shadow.range.is_empty() {
            return Ok(Vec3::ZERO);
        }
        match self.intersect(&shadow, tally)? {
            Some(_) => Ok(Vec3::ZERO),
            None => Ok(albedo * std::f32::consts::FRAC_1_PI * cosine * lit.radiance),
        }
    }

    fn ray_from(&self, surface: &Surface, dir: Vec3, max: f32) -> Ray {
        Ray {
            origin: surface.position,
            dir,
            range: Interval::new(self.epsilon, max),
        }
    }

    /// Asks the submission, and looks at its answer before anything is computed from it.
    fn intersect(
        &self,
        ray: &Ray,
        tally: &mut RenderStats,
    ) -> Result<Option<Surface>, InvalidSample> {
        tally.rays += 1;
        if !ray.origin.is_finite() || !ray.dir.is_finite() {
            return Err(InvalidSample);
        }
        let Some(trace) = self.world.hit(ray) else {
            return Ok(None);
        };
        let material = self.scene.materials.get(trace.material as usize);
        let (Some(&material), Some(normal)) = (material, trace.normal.try_normalize()) else {
            return Err(InvalidSample);
        };
        if !trace.position.is_finite() || !trace.uv.is_finite() {
            return Err(InvalidSample);
        }
        let outside = ray.dir.dot(normal) < 0.0;
        Ok(Some(Surface {
            position: trace.position,
            normal: if outside { normal } else { -normal },
            outside,
            uv: trace.uv,
            material,
        }))
    }
}

impl Surface {
    /// What a matte surface scatters; `None` for all others.
    fn albedo(&self) -> Option<Vec3> {
        match self.material {
            Material::Lambertian { albedo } => Some(albedo),
            Material::Checker { a, b, scale } => Some(checker(a, b, scale, self.uv)),
            Material::Mirror { .. } | Material::Glass { .. } | Material::Emitter { .. } => None,
        }
    }

    /// Where a path goes on; `None` where it ends.
    fn scatter(&self, incoming: Vec3, bounce: u32, sampler: &Sampler) -> Option<Scattered> {
        match self.material {
            Material::Lambertian { .. } | Material::Checker { .. } => {
                let around_normal =
                    sample_cosine_hemisphere(sampler.pair(bounce, Purpose::Direction));
                Some(Scattered {
                    direction: Frame::from_z(self.normal).to_world(around_normal),
                    // The cosine and π are those of the density, and cancel.
                    weight: self.albedo()?,
                    direct_light_sampled: true,
                })
            }
            Material::Mirror { reflectance } => Some(Scattered {
                direction: reflect(incoming, self.normal),
                weight: reflectance,
                direct_light_sampled: false,
            }),
            Material::Glass { ior } => {
                let eta = if self.outside { ior } else { 1.0 / ior };
                let met = interface(incoming, self.normal, eta);
                let choice = sampler.one(bounce, Purpose::ReflectOrRefract);
                let direction = met.refracted.filter(|_| choice >= met.reflectance);
                Some(Scattered {
                    direction: direction.unwrap_or_else(|| reflect(incoming, self.normal)),
                    // Picked as often as it counts. Radiance grows by eta² on the way in and
                    // shrinks by as much on the way out: neither is counted.
                    weight: Vec3::ONE,
                    direct_light_sampled: false,
                })
            }
            Material::Emitter { .. } => None,
        }
    }
}
