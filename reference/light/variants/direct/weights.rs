// Computes the weights of the balance heuristic, and divides each sample by its own density.

pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    let Material::Lambertian(material) = surface.material else {
        return Vec3::ZERO;
    };
    let mut light = Vec3::ZERO;

    if let Some(direction) = world.sample_light(surface.position, numbers) {
        let incoming = surface.to_local(direction);
        let own = world.light_pdf(surface.position, direction);
        let other = material.pdf(surface.out, incoming);
        if own > 0.0 {
            let weight = own / (own + other);
            let value = material.evaluate(surface.out, incoming);
            light += weight * value * world.emitted(surface, direction) / own;
        }
    }

    let scattered = material.scatter(surface.out, numbers.direct);
    let direction = surface.to_world(scattered.direction);
    let own = scattered.pdf.unwrap_or(0.0);
    let other = world.light_pdf(surface.position, direction);
    if own > 0.0 {
        let weight = own / (own + other);
        light += weight * scattered.attenuation * world.emitted(surface, direction);
    }
    light
}
