//! Lengths: distances along a ray.

use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number};
use crate::symptom::Side;

/// Tolerance for lengths (distances, positions and times), relative to the question's scale.
pub(crate) const TOLERANCE: f32 = 1e-4;

pub(super) struct Length(pub(super) f32);

impl FieldType for Length {
    fn text(&self) -> String {
        number(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Length)
    }

    fn error(&self, wanted: &Value, scale: f32) -> f64 {
        let Value::Length(wanted) = wanted else {
            return f64::INFINITY;
        };
        error(self.0, *wanted, scale, TOLERANCE)
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        let Value::Length(wanted) = wanted else {
            return None;
        };
        Side::of(self.0, *wanted)
    }

    fn in_tolerances(&self, scale: f32) -> Vec<f32> {
        in_tolerances(&[self.0], scale)
    }
}

/// Returns the error of a length, as a multiple of `tolerance`, which is relative to `scale` or to
/// the length itself, whichever is larger.
pub(crate) fn error(got: f32, wanted: f32, scale: f32, tolerance: f32) -> f64 {
    // ∞ − ∞ is NaN, which is treated as an infinite error.
    let limit = tolerance * wanted.abs().max(scale);
    in_units_of(limit.into(), (got - wanted).abs().into())
}

/// Returns lengths as multiples of their tolerance.
pub(super) fn in_tolerances(lengths: &[f32], scale: f32) -> Vec<f32> {
    // Avoid a tolerance of 0 if everything in a question is at the origin.
    let tolerance = (TOLERANCE * scale).max(f32::MIN_POSITIVE);
    lengths.iter().map(|length| length / tolerance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_compared_relative_to_the_scale() {
        assert!(error(1000.05, 1000.0, 1.0, TOLERANCE) <= 1.0);
        assert!(error(-1000.05, -1000.0, 1.0, TOLERANCE) <= 1.0);
        assert!(error(0.05, 0.0, 1000.0, TOLERANCE) <= 1.0);
        assert!(error(0.0005, 0.0, 1.0, TOLERANCE) > 1.0);
        assert!(error(0.00105, 0.001, 0.01, TOLERANCE) > 1.0);
        assert_eq!(error(3.0, 3.0, 1.0, TOLERANCE), 0.0);
        let three = error(10.003, 10.0, 1.0, TOLERANCE);
        assert!((three - 3.0).abs() < 0.03, "{three}");
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(error(bad, 1.0, 1.0, TOLERANCE), f64::INFINITY);
            assert_eq!(error(bad, f32::MAX, 1.0, TOLERANCE), f64::INFINITY);
        }
    }

    #[test]
    fn lengths_at_the_origin_are_finite_in_tolerances() {
        assert_eq!(in_tolerances(&[0.0, -0.0], 0.0), [0.0, 0.0]);
    }
}
