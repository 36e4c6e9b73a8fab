// A closure that gets a direction in both frames.

pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    let Surface {
        position,
        material: Material::Lambertian(material),
        out,
        ..
    } = *surface
    else {
        return Vec3::ZERO;
    };
    let light_from = |direction: Vec3, incoming: Vec3| {
        let pdf = world.light_pdf(position, direction) + material.pdf(out, incoming);
        if pdf == 0.0 {
            return Vec3::ZERO;
        }
        let fraction = material.evaluate(out, incoming) / pdf;
        fraction * world.emitted(surface, direction)
    };
    let incoming = material.scatter(out, numbers.direct).direction;
    let by_material = light_from(surface.to_world(incoming), incoming);
    let toward_light = world
        .sample_light(position, numbers)
        .map_or(Vec3::ZERO, |direction| {
            light_from(direction, surface.to_local(direction))
        });
    toward_light + by_material
}
