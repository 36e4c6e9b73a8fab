//! Measures the errors of numbers and vectors, as multiples of their tolerance. Values up to 1 are
//! accepted.
//!
//! No result is NaN: the error of values that cannot be compared is infinite.

use glam::{Vec2, Vec3};

/// Tolerance of lengths: distances, positions and times. Relative to the scale of the question.
pub(crate) const LENGTH: f32 = 1e-4;
/// Tolerance of unit vectors, as the length of their difference.
pub(crate) const DIRECTION: f32 = 1e-3;
/// Tolerance of texture coordinates.
pub(crate) const UV: f32 = 2e-3;

/// Returns `error` as a multiple of `limit`.
pub(super) fn in_units_of(limit: f64, error: f64) -> f64 {
    // An error of 0 is accepted even if the limit is 0.
    if error <= 0.0 {
        return 0.0;
    }
    let multiple = error / limit;
    if multiple.is_nan() {
        f64::INFINITY
    } else {
        multiple
    }
}

/// Returns the error of a length, as a multiple of `tolerance`, which is relative to `scale` or to
/// the length itself, whichever is larger.
pub(super) fn length_error(got: f32, wanted: f32, scale: f32, tolerance: f32) -> f64 {
    // ∞ − ∞ is NaN, which counts as infinitely far off.
    let limit = tolerance * wanted.abs().max(scale);
    in_units_of(limit.into(), (got - wanted).abs().into())
}

/// Returns the distance of a position from the expected one, as a multiple of its tolerance, which
/// is relative to `scale`.
pub(super) fn point_error(got: Vec3, wanted: Vec3, scale: f32) -> f64 {
    let limit = LENGTH * scale;
    in_units_of(limit.into(), got.distance(wanted).into())
}

/// Returns the error of a direction, as a multiple of `tolerance`. The length of `got` does not
/// matter.
pub(super) fn direction_error(got: Vec3, wanted: Vec3, tolerance: f32) -> f64 {
    // f64 prevents overflow and underflow for all finite f32 vectors.
    let got = got.as_dvec3();
    let unit = got / got.length();
    in_units_of(tolerance.into(), (unit - wanted.as_dvec3()).length())
}

/// Returns the error in the length of a vector that should have length one.
pub(super) fn unit_error(got: Vec3) -> f64 {
    in_units_of(DIRECTION.into(), (got.length() - 1.0).abs().into())
}

/// Returns the error of texture coordinates, where u wraps around.
pub(super) fn uv_error(got: Vec2, wanted: Vec2) -> f64 {
    let u = (got.x - wanted.x).abs();
    // A difference of exactly one turn is not an error. A larger difference is, because u must be
    // between 0 and 1.
    let u = u.min((1.0 - u).abs());
    let v = (got.y - wanted.y).abs();
    let error = |error: f32| in_units_of(UV.into(), error.into());
    error(u).max(error(v))
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;

    #[test]
    fn lengths_are_compared_relative_to_the_scale() {
        assert!(length_error(1000.05, 1000.0, 1.0, LENGTH) <= 1.0);
        assert!(length_error(-1000.05, -1000.0, 1.0, LENGTH) <= 1.0);
        assert!(length_error(0.05, 0.0, 1000.0, LENGTH) <= 1.0);
        assert!(length_error(0.0005, 0.0, 1.0, LENGTH) > 1.0);
        assert!(length_error(0.00105, 0.001, 0.01, LENGTH) > 1.0);
        assert!(point_error(Vec3::X * 1.00005, Vec3::X, 1.0) <= 1.0);
        assert!(point_error(Vec3::X * 1.00005, Vec3::X, 0.1) > 1.0);
    }

    #[test]
    fn errors_are_multiples_of_the_tolerance() {
        let close = |got: f64, wanted: f64| (got - wanted).abs() < 1e-2 * wanted;
        assert_eq!(length_error(3.0, 3.0, 1.0, LENGTH), 0.0);
        assert!(close(length_error(10.003, 10.0, 1.0, LENGTH), 3.0));
        assert!(close(point_error(Vec3::X * 0.0002, Vec3::ZERO, 1.0), 2.0));
        assert!(close(unit_error(Vec3::X * 1.5), 500.0));
        assert!(close(unit_error(Vec3::X * 0.5), 500.0));
        assert!(close(uv_error(vec2(0.5, 0.5), vec2(0.501, 0.5)), 0.5));
    }

    #[test]
    fn the_length_of_a_direction_does_not_matter() {
        let wanted = Vec3::new(2.0, -1.0, 2.0) / 3.0;
        for length in [1e-40_f32, 1e-30, 1.0, 1e30, 1e38] {
            let error = direction_error(wanted * length, wanted, DIRECTION);
            assert!(error <= 1.0, "{length}: {error}");
        }
        assert!(direction_error(-wanted * 1e38, wanted, DIRECTION) > 1.0);
    }

    #[test]
    fn a_zero_limit_allows_only_a_zero_error() {
        assert_eq!(in_units_of(0.0, 0.0), 0.0);
        assert_eq!(in_units_of(0.0, 1e-30), f64::INFINITY);
    }

    #[test]
    fn non_finite_values_are_infinitely_far_off() {
        const FAR: f64 = f64::INFINITY;
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(length_error(bad, 1.0, 1.0, LENGTH), FAR);
            assert_eq!(length_error(bad, f32::MAX, 1.0, LENGTH), FAR);
            assert_eq!(point_error(Vec3::splat(bad), Vec3::ONE, 1.0), FAR);
            assert_eq!(direction_error(Vec3::splat(bad), Vec3::X, DIRECTION), FAR);
            assert_eq!(unit_error(Vec3::splat(bad)), FAR);
            assert_eq!(uv_error(vec2(bad, 0.5), vec2(0.5, 0.5)), FAR);
            assert_eq!(uv_error(vec2(0.5, bad), vec2(0.5, 0.5)), FAR);
        }
        assert_eq!(direction_error(Vec3::ZERO, Vec3::X, DIRECTION), FAR);
    }

    #[test]
    fn u_wraps_around_but_v_does_not() {
        assert!(uv_error(vec2(0.9995, 0.5), vec2(0.0005, 0.5)) <= 1.0);
        assert!(uv_error(vec2(0.5, 0.9995), vec2(0.5, 0.0005)) > 1.0);
    }
}
