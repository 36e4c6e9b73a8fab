//! Part two, step 5: following a path of light from the camera.
//!
//! ```text
//!      camera o                 light     At each matte surface, `direct` finds the direct light.
//!              ╲             ─────────    The path itself goes on in a sampled direction, and
//!               ╲           . direct      `throughput` is the product of all attenuations so far.
//!                ╲        .
//!                 ╲     .   . ╲ direct    So a light that the path hits after a matte surface has
//!                  ╲  .   .    ╲          been counted already. After a mirror or glass, it has not.
//!          ─────────o─────────▶ o ─▶ …
//! ```

use framework::render::sampler::Sampler;
use glam::Vec3;
use protocol::Ray;

#[allow(unused_imports, reason = "your code will use it")]
use crate::direct::direct;
use crate::world::World;

/// Estimates the radiance that arrives at the origin of a ray, by following one path. See Kajiya,
/// "The Rendering Equation", SIGGRAPH 1986, and PBR, section 13.4.
///
/// - The path is scattered at most `bounces` times. With 0 bounces, the result is only the light
///   emitted by the surface that the ray hits, or the environment if the ray hits nothing. With 1
///   bounce, direct light is added.
/// - Bounce 0 is at the first surface. At each bounce, the path adds [`direct`] light and continues
///   in the direction that `Material::scatter` returns. Both use the random numbers
///   `sampler.numbers(bounce)`. Everything after the bounce is multiplied by the attenuation.
/// - The light that a surface emits, or the environment if the ray hits nothing, is counted only if
///   the ray comes from the camera, a mirror or glass (whose `pdf` is `None`). After a matte
///   surface, `direct` has already counted it.
/// - A path ends at a surface that scatters nothing, when its throughput is zero, or by chance:
///   from bounce 3 on (the fourth surface), it survives if `numbers.survive` is less than q, and
///   its throughput is divided by q. This is Russian roulette: see PBR, section 2.2.4. Here, q is
///   the largest channel of the throughput after this bounce's attenuation, but at least 0.05 and
///   at most 0.95.
pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {
    let _ = (world, sampler);
    todo!("part two, path: how much light does {ray:?} carry after {bounces} bounces?")
}

#[cfg(test)]
mod tests {
    use framework::scene::{self, Environment};
    use glam::UVec2;

    use super::*;
    use crate::direct::tests::{Floor, GREY, MIRROR};
    use crate::world::LightSources;

    /// Returns the radiance along a ray over a floor under a uniform sky with a radiance of 1.
    fn over(floor: scene::Material, dir: Vec3, bounces: u32) -> f32 {
        let sources = LightSources::new(Vec::new(), &Environment::Constant(Vec3::ONE));
        let floor = Floor(floor);
        let world = World::new(&floor, &sources);
        let sampler = Sampler::new(0, UVec2::ZERO, 0);
        radiance(&world, Ray::new(Vec3::Y, dir), &sampler, bounces).x
    }

    #[track_caller]
    fn assert_near(got: f32, expected: f32) {
        assert!(
            (got - expected).abs() < 1e-5,
            "expected {expected}, got {got}"
        );
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn without_bounces_only_what_shines_itself_is_seen() {
        assert_near(over(GREY, Vec3::Y, 0), 1.0);
        assert_near(over(GREY, Vec3::NEG_Y, 0), 0.0);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn the_sky_is_counted_once_for_each_material() {
        for bounces in [1, 2, 9] {
            assert_near(over(GREY, Vec3::NEG_Y, bounces), 0.5);
            assert_near(over(MIRROR, Vec3::NEG_Y, bounces), 0.5);
        }
    }
}
