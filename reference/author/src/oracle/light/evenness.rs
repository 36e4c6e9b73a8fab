//! How evenly directions are distributed over the sphere.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, dvec3};

/// The number of bands of equal height, and of sectors around the y-axis.
pub const SIDE: usize = 8;

/// Returns a uniformly distributed direction for two uniformly distributed numbers in `[0, 1)`, by
/// Archimedes' theorem: projecting a sphere to the cylinder around it preserves areas. This is one
/// of many such functions.
pub fn uniform_sphere(random: DVec2) -> DVec3 {
    let y = 2.0 * random.y - 1.0;
    let radius = libm::sqrt((1.0 - y) * (1.0 + y));
    let (sine, cosine) = libm::sincos(TAU * random.x);
    dvec3(radius * cosine, y, radius * sine)
}

/// Returns Pearson's χ² statistic of the numbers of directions in [`SIDE`] × [`SIDE`] cells of equal
/// area: bands of equal height along the y-axis, divided into sectors of equal angle around it.
/// Returns zero for no directions.
///
/// For uniformly distributed directions, it has a χ² distribution with 63 degrees of freedom: a
/// mean of 63 and a probability of 1e-9 to exceed 155.07.
pub fn chi_squared(directions: impl IntoIterator<Item = DVec3>) -> f64 {
    let mut counts = [0_u32; SIDE * SIDE];
    for direction in directions {
        counts[cell(direction)] += 1;
    }
    let expected = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
    if expected == 0.0 {
        return 0.0;
    }
    let deviations = counts.map(|count| f64::from(count) - expected);
    deviations.map(|d| d * d).iter().sum::<f64>() / expected
}

/// Returns the index of the cell that a direction is in.
fn cell(direction: DVec3) -> usize {
    let turn = libm::atan2(direction.z, direction.x) / TAU;
    let fractions = [0.5 - 0.5 * direction.y, turn - libm::floor(turn)];
    // Rounding can make a fraction equal to 1. The conversion to an integer rounds toward zero and
    // replaces negative numbers by zero.
    let [band, sector] = fractions.map(|x| ((x * SIDE as f64) as usize).min(SIDE - 1));
    SIDE * band + sector
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::light::grid;
    use crate::seed::Seed;

    #[test]
    fn a_grid_fills_all_cells_equally() {
        let directions = || grid(8 * 5).map(uniform_sphere);
        assert!(directions().all(|v| v.is_normalized()));
        assert_eq!(chi_squared(directions()), 0.0);
        assert_eq!(chi_squared([]), 0.0);
    }

    #[test]
    fn one_direction_is_not_even() {
        // 64 directions in one cell instead of one in each: (63² + 63) / 1.
        let directions = [DVec3::Y; 64];
        assert_eq!(chi_squared(directions), 63.0 * 64.0);
    }

    #[test]
    fn random_directions_pass_and_clustered_ones_fail() {
        let mut rng = Seed(7).rng("evenness");
        let even: Vec<DVec3> = (0..4096).map(|_| rng.direction()).collect();
        assert!((20.0..155.0).contains(&chi_squared(even)));
        // Uniform angles cluster at the poles.
        let clustered = (0..4096).map(|_| {
            let (theta, phi) = (rng.uniform(0.0, 0.5 * TAU), rng.uniform(0.0, TAU));
            let (sine, cosine) = libm::sincos(theta);
            dvec3(sine * libm::cos(phi), cosine, sine * libm::sin(phi))
        });
        assert!(chi_squared(clustered) > 155.07);
    }
}
