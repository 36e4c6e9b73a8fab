//! Matte surfaces, which reflect the same radiance in all directions. Directions are in the
//! surface's frame.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec3};

use super::Scattered64;

/// Returns the fraction of the light from `incoming` that is scattered to `out`, per solid angle,
/// times the cosine of `incoming`. Lambert's law: the fraction per projected solid angle is
/// constant, and its integral over the hemisphere, whose projection is the unit disc, is the
/// albedo.
pub fn evaluate(albedo: DVec3, out: DVec3, incoming: DVec3) -> DVec3 {
    if out.dot(DVec3::Z).min(incoming.dot(DVec3::Z)) <= 0.0 {
        return DVec3::ZERO;
    }
    let per_projected_solid_angle = albedo / PI;
    per_projected_solid_angle * incoming.dot(DVec3::Z)
}

/// Returns the probability density, per solid angle, with which [`scatter`] chooses `incoming`. The
/// points on the unit disc below the directions are evenly distributed, with density 1 / π, and a
/// solid angle's projection to the disc is smaller by the cosine.
pub fn pdf(out: DVec3, incoming: DVec3) -> f64 {
    let cosine = incoming.dot(DVec3::Z);
    let is_above = out.dot(DVec3::Z) > 0.0 && cosine > 0.0;
    if is_above { cosine / PI } else { 0.0 }
}

/// Samples a direction with two random numbers in `[0, 1)`. `out` must be above the surface.
pub fn scatter(albedo: DVec3, out: DVec3, random: DVec2) -> Scattered64 {
    let direction = sample_cosine_hemisphere(random);
    Scattered64 {
        direction,
        attenuation: albedo,
        pdf: Some(pdf(out, direction)),
    }
}

/// Samples a direction above the surface whose density is its cosine divided by π.
///
/// `random.x` is the probability that a direction is closer to the normal, which is the squared
/// sine of the angle θ between them. `random.y` is the fraction of a full turn.
pub fn sample_cosine_hemisphere(random: DVec2) -> DVec3 {
    let theta = libm::atan2(libm::sqrt(random.x), libm::sqrt(1.0 - random.x));
    let (sin_theta, cos_theta) = libm::sincos(theta);
    let (sin_phi, cos_phi) = libm::sincos(TAU * random.y);
    dvec3(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::light::{grid, uniform_sphere};

    const ALBEDO: DVec3 = DVec3::new(0.9, 0.5, 0.1);

    /// Returns the integral of a function over all directions.
    fn integral(function: impl Fn(DVec3) -> f64) -> f64 {
        let side = 200;
        let sum: f64 = grid(side).map(|at| function(uniform_sphere(at))).sum();
        sum * 4.0 * PI / f64::from(side * side)
    }

    #[test]
    fn the_scattered_fraction_is_the_albedo_and_the_density_integrates_to_one() {
        let out = dvec3(0.6, 0.0, 0.8);
        let scattered = integral(|incoming| evaluate(ALBEDO, out, incoming).x);
        assert!((scattered - ALBEDO.x).abs() < 5e-4, "{scattered}");
        let total = integral(|incoming| pdf(out, incoming));
        assert!((total - 1.0).abs() < 5e-4, "{total}");
    }

    #[test]
    fn scattering_is_reciprocal() {
        let (a, b) = (dvec3(0.6, 0.0, 0.8), dvec3(0.0, -0.8, 0.6));
        let (forward, backward) = (evaluate(ALBEDO, a, b), evaluate(ALBEDO, b, a));
        assert!((forward * a.z).abs_diff_eq(backward * b.z, 1e-15));
    }

    #[test]
    fn nothing_is_scattered_through_the_surface() {
        let (above, below) = (dvec3(0.6, 0.0, 0.8), dvec3(0.6, 0.0, -0.8));
        for (out, incoming) in [(above, below), (below, above), (below, below)] {
            assert_eq!(evaluate(ALBEDO, out, incoming), DVec3::ZERO);
            assert_eq!(pdf(out, incoming), 0.0);
        }
    }

    #[test]
    fn attenuation_is_the_scattered_fraction_over_the_density() {
        let out = dvec3(0.6, 0.0, 0.8);
        for random in grid(10) {
            let scattered = scatter(ALBEDO, out, random);
            let pdf = scattered.pdf.expect("a matte surface has a density");
            let quotient = evaluate(ALBEDO, out, scattered.direction) / pdf;
            assert!(quotient.abs_diff_eq(scattered.attenuation, 1e-14));
        }
    }

    #[test]
    fn sampled_directions_have_the_density() {
        // The mean of any function of the samples is its integral times the density.
        let side = 200;
        let function = |v: DVec3| v.x * v.x + v.y * v.z;
        let mean = grid(side).map(|at| function(sample_cosine_hemisphere(at)));
        let mean = mean.sum::<f64>() / f64::from(side * side);
        let expected = integral(|v| function(v) * pdf(DVec3::Z, v));
        assert!((mean - expected).abs() < 1e-4, "{mean} {expected}");
        let hand_computed = sample_cosine_hemisphere(DVec2::new(0.36, 0.25));
        assert!(hand_computed.abs_diff_eq(dvec3(0.0, 0.6, 0.8), 1e-15));
    }
}
