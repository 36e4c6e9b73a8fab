// A loop that ends when there is no next ray.

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let (mut light, mut throughput) = (Vec3::ZERO, Vec3::ONE);
    let mut last_pdf = None;
    let mut bounce = 0;
    let mut next = Some(ray);
    while let Some(ray) = next.take() {
        let surface = world.hit(&ray);
        if last_pdf.is_none() {
            let seen = match &surface {
                Some(surface) => surface.emitted,
                None => world.environment(ray.dir),
            };
            light += throughput * seen;
        }
        if let Some(surface) = surface
            && bounce < bounces
        {
            let numbers = sampler.numbers(bounce);
            light += throughput * direct(world, &surface, &numbers);
            if let Some(scattered) = surface.material.scatter(surface.out, &numbers) {
                throughput *= scattered.attenuation;
                let q = match bounce {
                    0..=2 => 1.0,
                    _ => throughput.max_element().clamp(0.05, 0.95),
                };
                if numbers.survive < q {
                    throughput /= q;
                    last_pdf = scattered.pdf;
                    next = Some(surface.leave(surface.to_world(scattered.direction)));
                }
            }
            bounce += 1;
        }
    }
    light
}
