// A function for the light from one direction, called for each sample.

pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    match surface.material {
        Material::Lambertian(material) => {
            let mut sum = Vec3::ZERO;
            if let Some(direction) = world.sample_light(surface.position, numbers) {
                sum += term(world, surface, &material, direction);
            }
            let scattered = material.scatter(surface.out, numbers.direct);
            let direction = surface.to_world(scattered.direction);
            sum + term(world, surface, &material, direction)
        }
        Material::Mirror(_) | Material::Glass(_) | Material::Emitter => Vec3::ZERO,
    }
}

/// Returns the term of a direction in the world: what arrives from there and is scattered, divided by
/// the sum of both densities.
fn term(
    world: &World,
    surface: &Surface,
    material: &crate::material::Lambertian,
    direction: Vec3,
) -> Vec3 {
    let incoming = surface.to_local(direction);
    let densities = [
        world.light_pdf(surface.position, direction),
        material.pdf(surface.out, incoming),
    ];
    let sum = densities[0] + densities[1];
    if sum <= 0.0 {
        return Vec3::ZERO;
    }
    material.evaluate(surface.out, incoming) * world.emitted(surface, direction) / sum
}
