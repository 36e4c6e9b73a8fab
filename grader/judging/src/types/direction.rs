//! Directions, compared regardless of their length, and the length of a direction, which should be
//! one.

use glam::Vec3;
use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number, point};
use crate::symptom::Side;

/// Tolerance for unit vectors, which limits the length of their difference.
pub(crate) const TOLERANCE: f32 = 1e-3;

pub(super) struct Direction(pub(super) Vec3);

impl FieldType for Direction {
    fn text(&self) -> String {
        point::text(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Direction)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::Direction(wanted) = wanted else {
            return f64::INFINITY;
        };
        error(self.0, *wanted, TOLERANCE)
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        if self.0.is_nan() {
            return Some(Side::NotANumber);
        }
        let opposite = Direction(-self.0);
        (opposite.error(wanted, 1.0) <= 1.0).then_some(Side::Reversed)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        let unit = self.0 / self.0.length();
        (unit / TOLERANCE).to_array().to_vec()
    }
}

/// Returns the error of a direction, as a multiple of `tolerance`. The length of `got` is ignored.
pub(crate) fn error(got: Vec3, wanted: Vec3, tolerance: f32) -> f64 {
    // f64 prevents overflow and underflow for all finite f32 vectors.
    let got = got.as_dvec3();
    let unit = got / got.length();
    in_units_of(tolerance.into(), (unit - wanted.as_dvec3()).length())
}

/// A direction, compared by its length only.
pub(crate) struct UnitLength(pub(crate) Vec3);

impl FieldType for UnitLength {
    fn text(&self) -> String {
        number(self.0.length())
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Direction)
    }

    fn error(&self, _: &Value, _: f32) -> f64 {
        let error = (self.0.length() - 1.0).abs();
        in_units_of(TOLERANCE.into(), error.into())
    }

    fn side(&self, _: &Value) -> Option<Side> {
        self.0.is_nan().then_some(Side::NotANumber)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        vec![self.0.length() / TOLERANCE]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_of_a_direction_does_not_matter() {
        let wanted = Vec3::new(2.0, -1.0, 2.0) / 3.0;
        for length in [1e-40_f32, 1e-30, 1.0, 1e30, 1e38] {
            let error = error(wanted * length, wanted, TOLERANCE);
            assert!(error <= 1.0, "{length}: {error}");
        }
        assert!(error(-wanted * 1e38, wanted, TOLERANCE) > 1.0);
    }

    #[test]
    fn only_the_opposite_direction_is_reversed() {
        let side = |got: Vec3| Direction(got).side(&Value::Direction(Vec3::Y));
        assert_eq!(side(-2.0 * Vec3::Y), Some(Side::Reversed));
        for other in [Vec3::Y, Vec3::X, Vec3::new(0.1, -1.0, 0.0), Vec3::ZERO] {
            assert_eq!(side(other), None, "{other}");
        }
        assert_eq!(side(Vec3::NAN), Some(Side::NotANumber));
    }

    #[test]
    fn vectors_without_a_direction_are_infinitely_far_off() {
        let none = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0];
        for bad in none.map(Vec3::splat) {
            assert_eq!(error(bad, Vec3::X, TOLERANCE), f64::INFINITY);
        }
    }

    #[test]
    fn a_length_above_or_below_one_is_an_error() {
        let error = |length: f32| {
            let vector = Vec3::X * length;
            UnitLength(vector).error(&Value::Direction(vector), 1.0)
        };
        for length in [0.5, 1.5] {
            assert!((error(length) - 500.0).abs() < 5.0);
        }
        assert_eq!(error(1.0), 0.0);
        assert_eq!(error(f32::NAN), f64::INFINITY);
        assert_eq!(error(f32::INFINITY), f64::INFINITY);
    }
}
