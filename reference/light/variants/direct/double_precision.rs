// Adds in double precision.

use glam::DVec3;

pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    let mut sum = DVec3::ZERO;
    if let Material::Lambertian(material) = &surface.material {
        let scattered = material.scatter(surface.out, numbers.direct).direction;
        let toward_light = world.sample_light(surface.position, numbers);
        let samples = [
            toward_light.map(|direction| (direction, surface.to_local(direction))),
            Some((surface.to_world(scattered), scattered)),
        ];
        for (direction, incoming) in samples.into_iter().flatten() {
            let light_pdf = f64::from(world.light_pdf(surface.position, direction));
            let scattering_pdf = f64::from(material.pdf(surface.out, incoming));
            let value = material.evaluate(surface.out, incoming).as_dvec3();
            let radiance = world.emitted(surface, direction).as_dvec3();
            let product = value * radiance;
            if product != DVec3::ZERO {
                sum += product / (light_pdf + scattering_pdf);
            }
        }
    }
    sum.as_vec3()
}
