// Recursion: each call returns the radiance along a ray. The throughput is only passed on for
// Russian roulette.

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let path = Recursion {
        world,
        sampler,
        bounces,
    };
    path.along(&ray, 0, Vec3::ONE, true)
}

struct Recursion<'a> {
    world: &'a World<'a>,
    sampler: &'a Sampler,
    bounces: u32,
}

impl Recursion<'_> {
    fn along(&self, ray: &Ray, bounce: u32, throughput: Vec3, counts_light: bool) -> Vec3 {
        let seen = |light: Vec3| if counts_light { light } else { Vec3::ZERO };
        let Some(surface) = self.world.hit(ray) else {
            return seen(self.world.environment(ray.dir));
        };
        let emitted = seen(surface.emitted);
        if bounce >= self.bounces {
            return emitted;
        }
        let numbers = self.sampler.numbers(bounce);
        let found = emitted + direct(self.world, &surface, &numbers);
        let Some(scattered) = surface.material.scatter(surface.out, &numbers) else {
            return found;
        };
        let mut attenuation = scattered.attenuation;
        if bounce >= 3 {
            let q = (throughput * attenuation).max_element().clamp(0.05, 0.95);
            if numbers.survive >= q {
                return found;
            }
            attenuation /= q;
        }
        let throughput = throughput * attenuation;
        if throughput == Vec3::ZERO {
            return found;
        }
        let next = surface.leave(surface.to_world(scattered.direction));
        let is_specular = scattered.pdf.is_none();
        found + attenuation * self.along(&next, bounce + 1, throughput, is_specular)
    }
}
