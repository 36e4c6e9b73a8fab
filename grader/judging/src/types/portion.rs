//! Probability densities and fractions of the light, compared relative to the expected value.

use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number};
use crate::symptom::Side;

/// Tolerance for colours, densities and fractions, relative to the expected value.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// A density or a fraction. `None` if a sample has no density.
pub(super) struct Portion(pub(super) Option<f32>);

impl FieldType for Portion {
    fn text(&self) -> String {
        self.0.map_or("None".to_owned(), number)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        match (self.0, expected(wanted)) {
            (None, None) => 0.0,
            (Some(got), Some(wanted)) => {
                let (got, wanted) = (f64::from(got), f64::from(wanted));
                in_units_of(TOLERANCE * wanted.abs(), (got - wanted).abs())
            }
            (Some(_), None) | (None, Some(_)) => f64::INFINITY,
        }
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        Side::of(self.0?, expected(wanted)?)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        // Distinguish `None` from every density.
        self.0
            .map_or(vec![-1.0], |portion| in_tolerances(&[portion]))
    }
}

/// Returns the number in an expected value, if any.
fn expected(wanted: &Value) -> Option<f32> {
    match *wanted {
        Value::Density(wanted) | Value::Fraction(wanted) => Some(wanted),
        Value::OptionalDensity(wanted) => wanted,
        _ => None,
    }
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
        let error = |got, wanted| Portion(got).error(&Value::OptionalDensity(wanted), 1.0);
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
}
