//! Part two, steps 1 and 2: how surfaces scatter light.
//!
//! ```text
//!        out   normal, +z                All directions have length one, point away from the
//!           ╲    │    ╱ direction        surface and are in the surface's frame, where +z is the
//!            ╲   │   ╱                   normal. `out` points to where the path came from, and
//!             ╲  │  ╱                    `direction` to where it goes next.
//!      ────────╲─┼─╱──────────
//!                │╲                      The normal of glass points out of the glass, so out.z < 0
//!                │ ╲ refracted           means that the path is inside. The normal of any other
//!                                        material is on the same side as `out`.
//! ```
//!
//! A path starts at the camera, so it follows the light backwards: light comes in from `direction`
//! and leaves toward `out`. The formulas are in the book *Physically Based Rendering* (PBR), 4th
//! edition: <https://pbr-book.org>.

#[allow(unused_imports, reason = "your code will use it")]
use std::f32::consts::FRAC_1_PI;

#[allow(unused_imports, reason = "your code will use it")]
use framework::render::frame::sample_cosine_hemisphere;
use glam::{Vec2, Vec3};

/// A sampled continuation of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// The direction of the rest of the path.
    pub direction: Vec3,
    /// The factor, for each colour channel, applied to the light from this direction: the scattered
    /// fraction per solid angle, times the cosine, divided by the probability density.
    pub attenuation: Vec3,
    /// The probability density of the direction, per solid angle, or `None` for mirrors and glass,
    /// which don't choose from a continuous range of directions.
    pub pdf: Option<f32>,
}

/// A matte surface. It reflects the same radiance in all directions.
#[derive(Clone, Copy, Debug)]
pub struct Lambertian {
    /// The fraction of light that is scattered, for each colour channel.
    pub albedo: Vec3,
}

/// A perfect mirror.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    /// The fraction of light that is reflected, for each colour channel.
    pub reflectance: Vec3,
}

/// Clear glass.
#[derive(Clone, Copy, Debug)]
pub struct Glass {
    /// The index of refraction of the glass, greater than zero. Outside, it is 1.
    pub ior: f32,
}

impl Lambertian {
    /// Returns the fraction of the light from `incoming` that is scattered to `out`, per solid
    /// angle: albedo / π · cos θ, where θ is the angle between `incoming` and the normal. See PBR,
    /// section 9.2, whose f doesn't include the cosine.
    ///
    /// - The result is zero unless both directions are above the surface (z > 0).
    pub fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        todo!("part two, lambertian: how much does {self:?} scatter from {incoming:?} to {out:?}?")
    }

    /// Returns the probability density, per solid angle, with which [`Lambertian::scatter`] chooses
    /// `incoming`: cos θ / π.
    ///
    /// - The result is zero unless both directions are above the surface (z > 0).
    pub fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        todo!("part two, lambertian: with what density is {incoming:?} sampled for {out:?}?")
    }

    /// Samples a direction above the surface with two random numbers in `[0, 1)`.
    ///
    /// - `direction` is the one that the given [`sample_cosine_hemisphere`] returns for `random`.
    /// - `attenuation` is [`Lambertian::evaluate`] divided by [`Lambertian::pdf`], simplified so
    ///   that it is also right at the horizon, where both are zero.
    /// - `pdf` is the density of this direction.
    /// - `out` is above the surface.
    pub fn scatter(&self, out: Vec3, random: Vec2) -> Scattered {
        todo!("part two, lambertian: which way does {random:?} scatter {out:?}?")
    }
}

/// Mirrors a direction about the normal.
///
/// - The result is on the same side of the surface as `out`, which can be on either side.
pub fn reflect(out: Vec3) -> Vec3 {
    todo!("part two, specular: which way does a mirror reflect {out:?}?")
}

/// Returns the direction on the other side of the surface of a medium with index of refraction
/// `ior`, according to Snell's law, or `None` for total reflection. See PBR, section 9.3.3.
///
/// - If out.z > 0, the path is outside, where the index is 1, and the result has z < 0. If out.z <
///   0, the path is inside, and the result has z > 0.
/// - `ior` can be less than 1, in which case total reflection can occur outside. It can also be 1,
///   in which case light isn't bent.
/// - The result has length one, even along the normal.
/// - Directions along the surface (z = 0), and those at the critical angle, are not tested.
pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    todo!("part two, specular: which way does an index of {ior} refract {out:?}?")
}

/// Returns the fraction of unpolarised light that the surface of a medium with index of refraction
/// `ior` reflects, according to the Fresnel equations. See PBR, section 9.3.5: the mean of the
/// squares of two ratios, one for each polarisation. Schlick's approximation isn't accurate enough.
///
/// - `out` can be on either side of the surface, as for [`refract`]. Two directions that refract
///   into each other have the same fraction.
/// - The result is 1 for total reflection, and 0 if `ior` is 1.
pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    todo!("part two, specular: how much of {out:?} does an index of {ior} reflect?")
}

impl Mirror {
    /// Returns the only direction that reflected light can come from.
    ///
    /// - `attenuation` is the reflectance, and `pdf` is `None`.
    pub fn scatter(&self, out: Vec3) -> Scattered {
        todo!("part two, specular: which way does {self:?} scatter {out:?}?")
    }
}

impl Glass {
    /// Chooses between reflection and refraction with a random number in `[0, 1)`: the path is
    /// reflected if and only if the number is less than [`fresnel`].
    ///
    /// - If the path is reflected, `attenuation` is 1: the fraction of the light that is reflected,
    ///   divided by the probability of reflection.
    /// - If the path is refracted, that quotient is 1, too, but where light enters a denser medium,
    ///   its rays are squeezed into a smaller solid angle, so their radiance grows. `attenuation` is
    ///   (η_out / η_in)², the square of the index on the side of `out` over the index on the side
    ///   that the light comes from. See PBR, section 9.5.2.
    /// - `pdf` is `None`.
    pub fn scatter(&self, out: Vec3, random: f32) -> Scattered {
        todo!("part two, specular: which way does {self:?} scatter {out:?} for {random}?")
    }
}

// Add your own functions here.

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;

    const GREY: Lambertian = Lambertian {
        albedo: Vec3::splat(0.5),
    };

    #[track_caller]
    fn assert_near(got: Vec3, expected: Vec3) {
        assert!(
            got.abs_diff_eq(expected, 1e-5),
            "expected {expected}, got {got}"
        );
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_matte_surface_scatters_less_light_from_a_slanted_direction() {
        let incoming = vec3(0.6, 0.0, 0.8);
        assert_near(
            GREY.evaluate(Vec3::Z, incoming),
            Vec3::splat(0.5 * 0.8 * FRAC_1_PI),
        );
        let below = vec3(0.6, 0.0, -0.8);
        assert_near(GREY.evaluate(Vec3::Z, below), Vec3::ZERO);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_sampled_direction_has_the_density_of_its_cosine() {
        let scattered = GREY.scatter(Vec3::Z, vec2(0.36, 0.25));
        assert_near(scattered.direction, vec3(0.0, 0.6, 0.8));
        assert_near(scattered.attenuation, GREY.albedo);
        let pdf = scattered.pdf.expect("expected a density, got None");
        assert_near(Vec3::splat(pdf), Vec3::splat(0.8 * FRAC_1_PI));
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_mirror_reflects_to_the_same_side() {
        assert_near(reflect(vec3(0.6, 0.0, 0.8)), vec3(-0.6, 0.0, 0.8));
        assert_near(reflect(vec3(0.0, 0.6, -0.8)), vec3(0.0, -0.6, -0.8));
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn glass_bends_light_toward_the_normal_and_back() {
        let (outside, inside) = (vec3(0.6, 0.0, 0.8), vec3(-0.4, 0.0, -0.84_f32.sqrt()));
        let entered = refract(outside, 1.5).expect("expected a direction, got None");
        assert_near(entered, inside);
        let left = refract(inside, 1.5).expect("expected a direction, got None");
        assert_near(left, outside);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn glass_reflects_four_percent_head_on_and_everything_beyond_the_critical_angle() {
        for out in [Vec3::Z, Vec3::NEG_Z] {
            assert_near(Vec3::splat(fresnel(out, 1.5)), Vec3::splat(0.04));
        }
        let beyond = vec3(0.8, 0.0, -0.6);
        assert_eq!(refract(beyond, 1.5), None);
        assert_near(Vec3::splat(fresnel(beyond, 1.5)), Vec3::ONE);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn the_random_number_decides_between_reflection_and_refraction() {
        let glass = Glass { ior: 1.5 };
        let reflected = glass.scatter(Vec3::Z, 0.03);
        assert_near(reflected.direction, Vec3::Z);
        assert_near(reflected.attenuation, Vec3::ONE);
        let refracted = glass.scatter(Vec3::Z, 0.05);
        assert_near(refracted.direction, Vec3::NEG_Z);
        assert_near(refracted.attenuation, Vec3::splat(1.0 / 2.25));
    }
}
