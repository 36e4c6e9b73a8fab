//! Probability densities and fractions of the light, compared relative to the expected value.

use std::mem::discriminant;

use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number};
use crate::symptom::Side;

/// Tolerance for colours, densities and fractions, relative to the expected value.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// The smallest fraction that the tolerance is relative to. Smaller fractions, which are differences
/// of numbers of the order of one, are compared as if they had this size.
const SMALLEST_FRACTION: f64 = 0.01;

/// A probability density or a fraction of the light.
pub(super) struct Portion<'a>(pub(super) &'a Value<'a>);

impl Portion<'_> {
    /// Returns the smallest number that the tolerance is relative to.
    fn smallest(&self) -> f64 {
        if matches!(self.0, Value::Fraction(_)) {
            SMALLEST_FRACTION
        } else {
            0.0
        }
    }
}

/// Returns the number in a value, or `None` for a sample without a density.
fn number_in(value: &Value) -> Option<f32> {
    if let Value::Density(number) | Value::Fraction(number) = *value {
        Some(number)
    } else if let Value::OptionalDensity(number) = *value {
        number
    } else {
        None
    }
}

impl FieldType for Portion<'_> {
    fn text(&self) -> String {
        number_in(self.0).map_or("None".to_owned(), number)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        if discriminant(self.0) != discriminant(wanted) {
            return f64::INFINITY;
        }
        match (number_in(self.0), number_in(wanted)) {
            (None, None) => 0.0,
            (Some(got), Some(wanted)) => relative_error(got, wanted, self.smallest()),
            (Some(_), None) | (None, Some(_)) => f64::INFINITY,
        }
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        Side::of_amount(number_in(self.0)?, number_in(wanted)?)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        match (number_in(self.0), self.smallest()) {
            // This distinguishes `None` from every density.
            (None, _) => vec![-1.0],
            (Some(number), 0.0) => in_tolerances(&[number]),
            (Some(number), smallest) => vec![number / (TOLERANCE * smallest) as f32],
        }
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
        // `max` ignores NaN, which isn't zero.
        if number.is_nan() {
            return f32::NAN;
        }
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
        let error = |got, wanted| {
            let got = Value::OptionalDensity(got);
            Portion(&got).error(&Value::OptionalDensity(wanted), 1.0)
        };
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
    fn nan_is_observed_as_itself() {
        let observed = in_tolerances(&[f32::NAN, 0.0, f32::INFINITY]);
        assert!(observed[0].is_nan());
        assert_eq!(observed[1..], [0.0, f32::INFINITY]);
    }

    #[test]
    fn tiny_fractions_are_equal_to_zero() {
        let error =
            |got, wanted| Portion(&Value::Fraction(got)).error(&Value::Fraction(wanted), 1.0);
        assert!(error(5e-6, 0.0) <= 1.0);
        assert!(error(5e-5, 0.0) > 1.0);
        assert!(error(0.5004, 0.5) <= 1.0);
        assert!(error(0.5006, 0.5) > 1.0);
        assert_eq!(error(f32::NAN, 0.5), f64::INFINITY);
    }
}
