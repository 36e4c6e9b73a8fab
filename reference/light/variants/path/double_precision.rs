// Throughput and light in double precision.

use glam::DVec3;

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let mut ray = ray;
    let mut light = DVec3::ZERO;
    let mut throughput = DVec3::ONE;
    let mut after_matte = false;
    let mut bounce = 0;
    loop {
        let hit = world.hit(&ray);
        let seen = hit
            .as_ref()
            .map_or_else(|| world.environment(ray.dir), |surface| surface.emitted);
        if !after_matte {
            light += throughput * seen.as_dvec3();
        }
        let Some(surface) = hit.filter(|_| bounce < bounces) else {
            return light.as_vec3();
        };
        let numbers = sampler.numbers(bounce);
        light += throughput * direct(world, &surface, &numbers).as_dvec3();
        let Some(scattered) = surface.material.scatter(surface.out, &numbers) else {
            return light.as_vec3();
        };
        throughput *= scattered.attenuation.as_dvec3();
        if bounce >= 3 {
            let q = throughput.max_element().clamp(0.05, 0.95);
            if f64::from(numbers.survive) >= q {
                return light.as_vec3();
            }
            throughput /= q;
        }
        after_matte = scattered.pdf.is_some();
        ray = surface.leave(surface.to_world(scattered.direction));
        bounce += 1;
    }
}
