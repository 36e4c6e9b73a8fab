//! Probability densities and fractions of the light, compared relative to the expected value.

use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number};
use crate::symptom::Side;

/// Tolerance for colours, densities and fractions, relative to the expected value.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// The smallest fraction that the tolerance is relative to. Smaller fractions, which are differences
/// of numbers of the order of one, are compared as if they had this size.
const SMALLEST_FRACTION: f64 = 0.01;

/// A density that there always is.
pub(super) struct Density(pub(super) f32);

/// A density, or `None` if a sample has no density.
pub(super) struct OptionalDensity(pub(super) Option<f32>);

/// A fraction of the light.
pub(super) struct Fraction(pub(super) f32);

impl FieldType for Density {
    fn text(&self) -> String {
        number(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::Density(wanted) = *wanted else {
            return f64::INFINITY;
        };
        relative_error(self.0, wanted, 0.0)
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        let Value::Density(wanted) = *wanted else {
            return None;
        };
        Side::of(self.0, wanted)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        in_tolerances(&[self.0])
    }
}

impl FieldType for OptionalDensity {
    fn text(&self) -> String {
        self.0.map_or("None".to_owned(), number)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::OptionalDensity(wanted) = *wanted else {
            return f64::INFINITY;
        };
        match (self.0, wanted) {
            (None, None) => 0.0,
            (Some(got), Some(wanted)) => relative_error(got, wanted, 0.0),
            (Some(_), None) | (None, Some(_)) => f64::INFINITY,
        }
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        let Value::OptionalDensity(Some(wanted)) = *wanted else {
            return None;
        };
        Side::of(self.0?, wanted)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        // Distinguish `None` from every density.
        self.0
            .map_or(vec![-1.0], |density| in_tolerances(&[density]))
    }
}

impl FieldType for Fraction {
    fn text(&self) -> String {
        number(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::Fraction(wanted) = *wanted else {
            return f64::INFINITY;
        };
        relative_error(self.0, wanted, SMALLEST_FRACTION)
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        let Value::Fraction(wanted) = *wanted else {
            return None;
        };
        Side::of(self.0, wanted)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        vec![self.0 / (TOLERANCE * SMALLEST_FRACTION) as f32]
    }
}

/// Returns the error of a number as a multiple of the tolerance, which is relative to the expected
/// number or to `smallest`, whichever is larger.
fn relative_error(got: f32, wanted: f32, smallest: f64) -> f64 {
    let (got, wanted) = (f64::from(got), f64::from(wanted));
    in_units_of(TOLERANCE * wanted.abs().max(smallest), (got - wanted).abs())
}

/// Returns the logarithms of numbers, with the numbers' signs, in units of the tolerance. So numbers
/// of any size differ by the same amount if they differ by the same factor.
pub(super) fn in_tolerances(numbers: &[f32]) -> Vec<f32> {
    /// Anything smaller is treated as zero.
    const SMALLEST: f32 = 1e-30;
    let steps = |number: &f32| {
        let logarithm = (number.abs() / SMALLEST).max(1.0).ln();
        logarithm.copysign(*number) / TOLERANCE as f32
    };
    numbers.iter().map(steps).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_are_compared_relative_to_the_expected_one() {
        let error = |got, wanted| OptionalDensity(got).error(&Value::OptionalDensity(wanted), 1.0);
        assert!(error(Some(1000.9), Some(1000.0)) <= 1.0);
        assert!(error(Some(1001.1), Some(1000.0)) > 1.0);
        assert!(error(Some(1.1e-6), Some(1e-6)) > 1.0);
        assert_eq!(error(Some(0.0), Some(0.0)), 0.0);
        assert_eq!(error(None, None), 0.0);
        for (got, wanted) in [
            (None, Some(0.0)),
            (Some(0.0), None),
            (Some(1e-9), Some(0.0)),
            (Some(f32::NAN), Some(1.0)),
        ] {
            assert_eq!(error(got, wanted), f64::INFINITY, "{got:?}, {wanted:?}");
        }
    }

    #[test]
    fn tiny_fractions_are_equal_to_zero() {
        let error = |got, wanted| Fraction(got).error(&Value::Fraction(wanted), 1.0);
        assert!(error(5e-6, 0.0) <= 1.0);
        assert!(error(5e-5, 0.0) > 1.0);
        assert!(error(0.5004, 0.5) <= 1.0);
        assert!(error(0.5006, 0.5) > 1.0);
        assert_eq!(error(f32::NAN, 0.5), f64::INFINITY);
    }
}
