//! When two numbers are the same. Every comparison is written so that NaN fails it.

use glam::{Vec2, Vec3};

/// Of lengths: distances, positions, times. Relative; absolute below 1.
pub(super) const LENGTH: f32 = 1e-4;
/// Of unit vectors, as the length of their difference.
pub(super) const DIRECTION: f32 = 1e-3;
/// Of texture coordinates.
pub(super) const UV: f32 = 2e-3;

/// Whether two lengths agree.
pub(super) fn same_length(got: f32, wanted: f32, tolerance: f32) -> bool {
    // An infinite error is never within a tolerance, and ∞ − ∞ is NaN.
    (got - wanted).abs() <= tolerance * wanted.abs().max(1.0)
}

/// Whether two points agree.
pub(super) fn same_point(got: Vec3, wanted: Vec3) -> bool {
    got.distance(wanted) <= LENGTH * wanted.length().max(1.0)
}

/// Whether two directions agree, whatever the length of the first.
pub(super) fn same_direction(got: Vec3, wanted: Vec3, tolerance: f32) -> bool {
    // In f64, so that no finite vector over- or underflows.
    let got = got.as_dvec3();
    let unit = got / got.length();
    (unit - wanted.as_dvec3()).length() <= f64::from(tolerance)
}

/// Whether a vector has length one.
pub(super) fn is_unit(got: Vec3) -> bool {
    (got.length() - 1.0).abs() <= DIRECTION
}

/// Whether two texture coordinates agree; u goes around.
pub(super) fn same_uv(got: Vec2, wanted: Vec2) -> bool {
    let u = (got.x - wanted.x).abs();
    // Once around is no difference; twice is not what a `uv` returns.
    let u = u.min((1.0 - u).abs());
    u <= UV && (got.y - wanted.y).abs() <= UV
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;

    #[test]
    fn lengths_are_compared_relatively_above_one() {
        assert!(same_length(1000.05, 1000.0, LENGTH));
        assert!(!same_length(0.0005, 0.0, LENGTH));
    }

    #[test]
    fn nothing_that_is_not_finite_is_the_same_as_anything() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(!same_length(bad, 1.0, LENGTH) && !same_length(bad, f32::MAX, LENGTH));
            assert!(!same_point(Vec3::splat(bad), Vec3::ONE));
            assert!(!same_direction(Vec3::splat(bad), Vec3::X, DIRECTION));
            assert!(!is_unit(Vec3::splat(bad)));
            assert!(!same_uv(vec2(bad, 0.5), vec2(0.5, 0.5)));
        }
        assert!(!same_direction(Vec3::ZERO, Vec3::X, DIRECTION));
    }

    #[test]
    fn u_goes_around_but_v_does_not() {
        assert!(same_uv(vec2(0.9995, 0.5), vec2(0.0005, 0.5)));
        assert!(!same_uv(vec2(0.5, 0.9995), vec2(0.5, 0.0005)));
    }
}
