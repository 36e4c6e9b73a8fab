//! Part two, step 4: direct light, which reaches a surface without being scattered on the way.
//!
//! ```text
//!             light                  Two directions are sampled: one toward a light, and one that
//!           ─────────                the material samples. If a light is small or far away, the
//!             ╱                      first rarely misses it and the second rarely hits it. Close to
//!            ╱ 1       . 2           a large light, the second is better.
//!           ╱       .
//!          ╱     .
//!         ╱   .                      Each sample is divided by the sum of both densities:
//!        ╱ .                         the balance heuristic.
//!   ────o────────────────
//! ```

use framework::render::sampler::RandomNumbers;
use glam::Vec3;

// starter: #[allow(unused_imports, reason = "your code will use them")]
use crate::world::{Material, Surface, World};

/// Estimates the direct light that a surface scatters back along the path, from one direction
/// toward a light and one that the material samples. See Veach and Guibas, "Optimally Combining
/// Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995, section 3.2.
///
/// - The result is the sum, over both directions, of evaluate × radiance / (light pdf + scattering
///   pdf). Each term uses both densities of its own direction, no matter which way that direction
///   was sampled.
/// - The first direction is the one that [`World::sample_light`] returns. If it returns `None`, the
///   first term is zero. [`World::light_pdf`] returns the light pdf.
/// - The second is the one that `Lambertian::scatter` returns for the random numbers
///   `numbers.direct`.
/// - The radiance is the light that arrives from this direction, straight from a light or the
///   environment. It is zero if something is in the way: see [`World::emitted`].
/// - A direction adds nothing if the sum of its densities is zero, or if `evaluate` is zero.
/// - Only matte surfaces look for direct light. The result is zero for all others, because a
///   direction toward a light is never exactly one that they reflect or refract to.
pub fn direct(world: &World, surface: &Surface, numbers: &RandomNumbers) -> Vec3 {
    // solution
    // starter: let _ = (world, numbers);
    // starter: let material = surface.material;
    // starter: todo!("part two, direct: how much direct light does {material:?} scatter?")
    let Material::Lambertian(lambertian) = surface.material else {
        return Vec3::ZERO;
    };
    let from = surface.position;
    let scattered = lambertian.scatter(surface.out, numbers.direct);
    let directions = [
        world.sample_light(from, numbers),
        Some(surface.to_world(scattered.direction)),
    ];
    let mut light = Vec3::ZERO;
    for direction in directions.into_iter().flatten() {
        let incoming = surface.to_local(direction);
        let value = lambertian.evaluate(surface.out, incoming);
        if value == Vec3::ZERO {
            continue;
        }
        let radiance = world.emitted(surface, direction);
        if radiance == Vec3::ZERO {
            continue;
        }
        let pdf = world.light_pdf(from, direction) + lambertian.pdf(surface.out, incoming);
        light += value * radiance / pdf;
    }
    light
    // end solution
}

#[cfg(test)]
pub(crate) mod tests {
    use std::f32::consts::FRAC_1_PI;

    use framework::render::tracer::{self, Intersect};
    use framework::scene::{self, Environment};
    use glam::{Vec2, Vec3, vec3};
    use protocol::{Ray, Shape};

    use super::*;
    use crate::lights::{AreaLight, Light};
    use crate::world::LightSources;

    /// An infinite floor at y = 0. Only rays from above hit it.
    pub(crate) struct Floor(pub(crate) scene::Material);

    impl Intersect for Floor {
        fn intersect(&self, ray: &Ray) -> Option<tracer::Surface<'_>> {
            const SHAPE: &Shape = &Shape::FlatTriangle {
                corners: [Vec3::ZERO, Vec3::Z, Vec3::X],
                shape: 0,
            };
            let distance = -ray.origin.y / ray.dir.y;
            let is_hit = ray.dir.y < 0.0 && ray.range.contains(distance);
            is_hit.then(|| tracer::Surface {
                shape: SHAPE,
                material: &self.0,
                eye: ray.origin,
                out: -ray.dir,
                position: ray.at(distance),
                normal: Vec3::Y,
                outside: true,
                uv: Vec2::ZERO,
            })
        }
    }

    pub(crate) const GREY: scene::Material = scene::Material::Lambertian {
        albedo: Vec3::splat(0.5),
    };
    pub(crate) const MIRROR: scene::Material = scene::Material::Mirror {
        reflectance: Vec3::splat(0.5),
    };

    /// Random numbers that lead to the middle of a light and, for the material, straight up.
    const NUMBERS: RandomNumbers = RandomNumbers {
        light: 0.5,
        on_light: Vec2::splat(0.5),
        direct: Vec2::ZERO,
        scatter: Vec2::ZERO,
        reflect: 0.5,
        survive: 0.5,
    };

    /// Returns the direct light that the floor scatters straight up.
    fn direct_on(floor: &Floor, sources: &LightSources) -> f32 {
        let world = World::new(floor, sources);
        let surface = world.hit(&Ray::new(Vec3::Y, Vec3::NEG_Y));
        direct(&world, &surface.expect("the floor is hit"), &NUMBERS).x
    }

    fn sky(radiance: f32) -> Environment {
        Environment::Constant(Vec3::splat(radiance))
    }

    // starter: #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn both_directions_lead_to_a_light_overhead() {
        let edges = [2.0 * Vec3::X, 2.0 * Vec3::Z];
        let square = AreaLight::parallelogram(vec3(-1.0, 3.0, -1.0), edges, Vec3::ONE);
        let sources = LightSources::new(vec![Light::Area(square)], &sky(0.0));
        // The density of the light is 3² / 4, and that of scattering 1 / π.
        let expected = 2.0 * 0.5 * FRAC_1_PI / (9.0 / 4.0 + FRAC_1_PI);
        let got = direct_on(&Floor(GREY), &sources);
        assert!(
            (got - expected).abs() < 1e-5,
            "expected {expected}, got {got}"
        );
    }

    // starter: #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn an_even_sky_is_only_reached_by_scattering() {
        let sources = LightSources::new(Vec::new(), &sky(1.0));
        let got = direct_on(&Floor(GREY), &sources);
        assert!((got - 0.5).abs() < 1e-5, "expected 0.5, got {got}");
        let got = direct_on(&Floor(MIRROR), &sources);
        assert_eq!(got, 0.0, "a mirror");
    }
}
