// A sum over an iterator of both directions.

pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    let material = match surface.material {
        Material::Lambertian(material) => material,
        Material::Mirror(_) | Material::Glass(_) | Material::Emitter => return Vec3::ZERO,
    };
    let by_material = || surface.to_world(material.scatter(surface.out, numbers.direct).direction);
    world
        .sample_light(surface.position, numbers)
        .into_iter()
        .chain(std::iter::once_with(by_material))
        .map(|direction| (direction, surface.to_local(direction)))
        .filter(|(_, incoming)| incoming.z > 0.0)
        .map(|(direction, incoming)| {
            let pdf =
                world.light_pdf(surface.position, direction) + material.pdf(surface.out, incoming);
            let radiance = world.emitted(surface, direction);
            material.evaluate(surface.out, incoming) * radiance / pdf
        })
        .sum()
}
