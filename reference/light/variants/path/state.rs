// The path as a value with a method that follows it by one ray.

use crate::world::Surface;

/// A path up to its next ray.
struct Path {
    ray: Ray,
    throughput: Vec3,
    /// Whether `direct` has counted the light that the ray hits.
    is_counted: bool,
    light: Vec3,
}

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let mut path = Path {
        ray,
        throughput: Vec3::ONE,
        is_counted: false,
        light: Vec3::ZERO,
    };
    for bounce in 0..bounces {
        let next = path
            .hit(world)
            .and_then(|surface| path.scatter(world, &surface, sampler, bounce));
        match next {
            Some(ray) => path.ray = ray,
            None => return path.light,
        }
    }
    path.hit(world);
    path.light
}

impl Path {
    /// Counts the light that the ray hits and returns the surface.
    fn hit<'a>(&mut self, world: &'a World) -> Option<Surface<'a>> {
        let surface = world.hit(&self.ray);
        if !self.is_counted {
            self.light += self.throughput
                * match &surface {
                    Some(surface) => surface.emitted,
                    None => world.environment(self.ray.dir),
                };
        }
        surface
    }

    /// Adds direct light and returns the next ray if the path goes on.
    fn scatter(
        &mut self,
        world: &World,
        surface: &Surface,
        sampler: &Sampler,
        bounce: u32,
    ) -> Option<Ray> {
        let numbers = sampler.numbers(bounce);
        self.light += self.throughput * direct(world, surface, &numbers);
        let scattered = surface.material.scatter(surface.out, &numbers)?;
        self.throughput *= scattered.attenuation;
        self.is_counted = scattered.pdf.is_some();
        if bounce >= 3 {
            let q = self.throughput.max_element().clamp(0.05, 0.95);
            if numbers.survive >= q {
                return None;
            }
            self.throughput /= q;
        }
        Some(surface.leave(surface.to_world(scattered.direction)))
    }
}
