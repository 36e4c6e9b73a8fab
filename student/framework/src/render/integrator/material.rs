//! How surfaces scatter light: matte surfaces, mirrors and glass.
//!
//! All directions are unit vectors that lead away from the surface. They are in the surface's
//! frame, where +z is the normal. `out` leads to where the path comes from, and `incoming` to where
//! the light comes from. The normal of glass points out of the glass. The normal of any other
//! material is on the same side of the surface as `out`.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use crate::render::frame::sample_cosine_hemisphere;

/// A sampled continuation of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scattered {
    /// The direction in which the path continues.
    pub(super) direction: Vec3,
    /// The factor applied to the light from this direction: `evaluate` divided by the probability
    /// density.
    pub(super) attenuation: Vec3,
    /// The probability density of the direction, per solid angle, or `None` for mirrors and glass,
    /// which have no other direction to choose.
    pub(super) pdf: Option<f32>,
}

/// A matte surface. It reflects the same radiance in all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lambertian {
    /// The fraction of light that is scattered, for each colour channel.
    pub(super) albedo: Vec3,
}

impl Lambertian {
    /// Returns the fraction of light from `incoming` that is scattered to `out`, per solid angle.
    /// The cosine is included.
    pub(super) fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        self.albedo * self.pdf(out, incoming)
    }

    /// Returns the probability density, per solid angle, with which [`Lambertian::scatter`] samples
    /// `incoming`.
    pub(super) fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        if out.z > 0.0 && incoming.z > 0.0 {
            incoming.z * FRAC_1_PI
        } else {
            0.0
        }
    }

    /// Samples a direction with two random numbers in `[0, 1)`.
    pub(super) fn scatter(&self, out: Vec3, random: Vec2) -> Scattered {
        let direction = sample_cosine_hemisphere(random);
        Scattered {
            direction,
            attenuation: self.albedo,
            pdf: Some(self.pdf(out, direction)),
        }
    }
}

/// A perfect mirror.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mirror {
    /// The fraction of light that is reflected, for each colour channel.
    pub(super) reflectance: Vec3,
}

impl Mirror {
    /// Returns the only direction that reflected light can come from.
    pub(super) fn scatter(&self, out: Vec3) -> Scattered {
        Scattered {
            direction: reflect(out),
            attenuation: self.reflectance,
            pdf: None,
        }
    }
}

/// Clear glass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glass {
    /// The index of refraction of the glass. Outside, it is 1.
    pub(super) ior: f32,
}

impl Glass {
    /// Chooses between reflection and refraction using a random number in `[0, 1)`. The probability
    /// of each equals its share of the light, so the share and the probability cancel.
    ///
    /// Where light enters a denser medium, its rays are squeezed into a smaller solid angle and its
    /// radiance grows. See Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition,
    /// section 9.5.2.
    pub(super) fn scatter(&self, out: Vec3, random: f32) -> Scattered {
        let refracted = refract(out, self.ior).filter(|_| random >= fresnel(out, self.ior));
        let Some(direction) = refracted else {
            return Scattered {
                direction: reflect(out),
                attenuation: Vec3::ONE,
                pdf: None,
            };
        };
        let ratio = index_ratio(out, self.ior);
        Scattered {
            direction,
            attenuation: Vec3::splat(ratio * ratio),
            pdf: None,
        }
    }
}

/// Mirrors a direction.
fn reflect(out: Vec3) -> Vec3 {
    Vec3::new(-out.x, -out.y, out.z)
}

/// Returns the direction on the other side of the interface according to Snell's law, or `None` for
/// total reflection.
fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    let ratio = index_ratio(out, ior);
    let sine_squared = ratio * ratio * (1.0 - out.z * out.z).max(0.0);
    if sine_squared >= 1.0 {
        return None;
    }
    let cosine = (1.0 - sine_squared).sqrt().copysign(-out.z);
    Some(Vec3::new(-ratio * out.x, -ratio * out.y, cosine).normalize())
}

/// Returns the fraction of unpolarised light that is reflected, according to the Fresnel equations.
/// See Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition, section 9.3.5.
fn fresnel(out: Vec3, ior: f32) -> f32 {
    let Some(refracted) = refract(out, ior) else {
        return 1.0;
    };
    let ratio = index_ratio(out, ior);
    let (near, far) = (out.z.abs(), refracted.z.abs());
    let parallel = (near - ratio * far) / (near + ratio * far);
    let perpendicular = (ratio * near - far) / (ratio * near + far);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// Returns the index of refraction on the side of `out`, divided by the index on the other side.
fn index_ratio(out: Vec3, ior: f32) -> f32 {
    if out.z > 0.0 { 1.0 / ior } else { ior }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slanted(sine: f32) -> Vec3 {
        Vec3::new(sine, 0.0, (1.0 - sine * sine).sqrt())
    }

    #[test]
    fn at_normal_incidence_glass_reflects_four_percent() {
        for out in [Vec3::Z, Vec3::NEG_Z] {
            assert!((fresnel(out, 1.5) - 0.04).abs() < 1e-6, "{out}");
            assert_eq!(refract(out, 1.5), Some(-out));
        }
    }

    #[test]
    fn refraction_follows_snells_law_and_can_be_reversed() {
        let out = slanted(0.6);
        let refracted = refract(out, 1.5).expect("light can always enter glass");
        assert!((refracted.x + 0.4).abs() < 1e-6, "{refracted}");
        assert!(refracted.is_normalized() && refracted.z < 0.0);
        let back = refract(refracted, 1.5).expect("light leaves where it came from");
        assert!(back.abs_diff_eq(out, 1e-6), "{back}");
        // The same share is reflected on both sides.
        assert!((fresnel(out, 1.5) - fresnel(refracted, 1.5)).abs() < 1e-6);
    }

    #[test]
    fn beyond_the_critical_angle_all_light_is_reflected() {
        for (sine, is_total) in [(0.7, true), (0.6, false)] {
            let out = -slanted(sine);
            assert_eq!(refract(out, 1.5).is_none(), is_total);
            assert_eq!(fresnel(out, 1.5) == 1.0, is_total);
        }
    }

    #[test]
    fn light_that_passes_through_glass_has_its_radiance_again() {
        let glass = Glass { ior: 1.5 };
        let enters = glass.scatter(slanted(0.6), 0.9);
        // On the other side of a pane, the path comes from inside.
        let leaves = glass.scatter(enters.direction, 0.9);
        let product = enters.attenuation * leaves.attenuation;
        assert!((product - 1.0).abs().max_element() < 1e-6, "{product}");
        assert!(enters.attenuation.x < 0.5, "{enters:?}");
    }

    #[test]
    fn a_matte_surface_scatters_nothing_through_itself() {
        let matte = Lambertian { albedo: Vec3::ONE };
        let below = slanted(0.3) * Vec3::new(1.0, 1.0, -1.0);
        assert_eq!(matte.evaluate(slanted(0.2), below), Vec3::ZERO);
        assert_eq!(matte.evaluate(below, slanted(0.2)), Vec3::ZERO);
    }
}
