// Looks at the first hit before the loop. Each turn of the loop scatters the path at a surface and
// finds the next one.

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let Some(mut surface) = world.hit(&ray) else {
        return world.environment(ray.dir);
    };
    let mut light = surface.emitted;
    let mut throughput = Vec3::ONE;
    for bounce in 0..bounces {
        let numbers = sampler.numbers(bounce);
        light += throughput * direct(world, &surface, &numbers);
        let Some(scattered) = surface.material.scatter(surface.out, &numbers) else {
            return light;
        };
        throughput *= scattered.attenuation;
        if bounce > 2 {
            let largest = throughput.x.max(throughput.y).max(throughput.z);
            let survival = largest.clamp(0.05, 0.95);
            if survival <= numbers.survive {
                return light;
            }
            throughput *= 1.0 / survival;
        }
        let direction = surface.to_world(scattered.direction);
        let next = world.hit(&surface.leave(direction));
        let is_counted = scattered.pdf.is_some();
        match next {
            Some(next) => {
                if !is_counted {
                    light += throughput * next.emitted;
                }
                surface = next;
            }
            None if is_counted => return light,
            None => return light + throughput * world.environment(direction),
        }
    }
    light
}
