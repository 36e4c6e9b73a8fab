//! Colours: a value for each of the channels red, green and blue.

use glam::Vec3;
use protocol::Value;

use super::portion::{TOLERANCE, in_tolerances};
use super::{FieldType, Tolerance, in_units_of, point};
use crate::symptom::Side;

/// A channel that is dimmer than this, as a fraction of the brightest one, is compared as if it had
/// this brightness.
const DIMMEST: f64 = 1e-6;

pub(super) struct Color(pub(super) Vec3);

impl FieldType for Color {
    fn text(&self) -> String {
        point::text(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Relative)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::Color(wanted) = wanted else {
            return f64::INFINITY;
        };
        let wanted = wanted.as_dvec3();
        let error = (self.0.as_dvec3() - wanted).abs();
        let dimmest = DIMMEST * wanted.abs().max_element();
        let channels = error.to_array().into_iter().zip(wanted.abs().to_array());
        let errors = channels.map(|(error, wanted)| {
            // `f64::max` would ignore a channel that is NaN.
            let error = if error.is_finite() {
                error
            } else {
                f64::INFINITY
            };
            in_units_of(TOLERANCE * wanted.max(dimmest), error)
        });
        errors.fold(0.0, f64::max)
    }

    fn side(&self, wanted: &Value) -> Option<Side> {
        let Value::Color(wanted) = wanted else {
            return None;
        };
        Side::of_amount(self.0.element_sum(), wanted.element_sum())
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        in_tolerances(&self.0.to_array())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_channel_is_compared_relative_to_its_expected_value() {
        let wanted = Value::Color(Vec3::new(10.0, 1.0, 0.0));
        let error = |color| Color(color).error(&wanted, 1.0);
        assert_eq!(error(Vec3::new(10.0, 1.0, 0.0)), 0.0);
        assert!(error(Vec3::new(10.009, 1.0009, 9e-9)) <= 1.0);
        assert!(error(Vec3::new(10.0, 1.002, 0.0)) > 1.0);
        assert!(error(Vec3::new(10.0, 1.0, 2e-8)) > 1.0);
        for bad in [f32::NAN, f32::INFINITY] {
            assert_eq!(error(Vec3::new(10.0, bad, 0.0)), f64::INFINITY);
        }
        let black = Value::Color(Vec3::ZERO);
        assert_eq!(Color(Vec3::ZERO).error(&black, 1.0), 0.0);
        assert_eq!(Color(Vec3::splat(1e-9)).error(&black, 1.0), f64::INFINITY);
    }
}
