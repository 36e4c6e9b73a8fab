// Records the path first, and then adds up its light from the last surface to the first.

/// The light found at a vertex of the path, and the factor for everything after it.
struct Vertex {
    light: Vec3,
    factor: Vec3,
}

pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let vertices = follow(world, ray, sampler, bounces);
    let add = |after: Vec3, vertex: &Vertex| vertex.light + vertex.factor * after;
    vertices.iter().rev().fold(Vec3::ZERO, add)
}

fn follow(world: &World, mut ray: Ray, sampler: &Sampler, bounces: u32) -> Vec<Vertex> {
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut is_specular = true;
    loop {
        let bounce = vertices.len() as u32;
        let Some(surface) = world.hit(&ray) else {
            if is_specular {
                vertices.push(Vertex {
                    light: world.environment(ray.dir),
                    factor: Vec3::ZERO,
                });
            }
            return vertices;
        };
        let mut vertex = Vertex {
            light: if is_specular {
                surface.emitted
            } else {
                Vec3::ZERO
            },
            factor: Vec3::ZERO,
        };
        if bounce == bounces {
            vertices.push(vertex);
            return vertices;
        }
        let numbers = sampler.numbers(bounce);
        vertex.light += direct(world, &surface, &numbers);
        let scattered = surface.material.scatter(surface.out, &numbers);
        let survivor = scattered.and_then(|scattered| {
            let before: Vec3 = vertices.iter().map(|vertex| vertex.factor).product();
            let q = survival(before * scattered.attenuation, bounce);
            (numbers.survive < q).then_some((scattered, q))
        });
        let Some((scattered, q)) = survivor else {
            vertices.push(vertex);
            return vertices;
        };
        vertex.factor = scattered.attenuation / q;
        vertices.push(vertex);
        is_specular = scattered.pdf.is_none();
        ray = surface.leave(surface.to_world(scattered.direction));
    }
}

/// Returns the probability that a path goes on after a bounce.
fn survival(throughput: Vec3, bounce: u32) -> f32 {
    if bounce < 3 {
        return 1.0;
    }
    throughput.max_element().clamp(0.05, 0.95)
}
