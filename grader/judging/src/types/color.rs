//! Colours: a value for each of the channels red, green and blue.

use glam::Vec3;
use protocol::Value;

use super::portion::{TOLERANCE, in_tolerances};
use super::{FieldType, Tolerance, in_units_of, point};
use crate::symptom::Side;

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
        // `max_element` can ignore a channel that is NaN.
        let largest = if error.is_finite() {
            error.max_element()
        } else {
            f64::INFINITY
        };
        in_units_of(TOLERANCE * wanted.abs().max_element(), largest)
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
    fn channels_are_compared_relative_to_the_brightest() {
        let wanted = Value::Color(Vec3::new(10.0, 1.0, 0.0));
        let error = |color| Color(color).error(&wanted, 1.0);
        assert_eq!(error(Vec3::new(10.0, 1.0, 0.0)), 0.0);
        assert!(error(Vec3::new(10.0, 1.009, 0.009)) <= 1.0);
        assert!(error(Vec3::new(10.0, 1.0, 0.02)) > 1.0);
        for bad in [f32::NAN, f32::INFINITY] {
            assert_eq!(error(Vec3::new(10.0, bad, 0.0)), f64::INFINITY);
        }
        let black = Value::Color(Vec3::ZERO);
        assert_eq!(Color(Vec3::ZERO).error(&black, 1.0), 0.0);
        assert_eq!(Color(Vec3::splat(1e-9)).error(&black, 1.0), f64::INFINITY);
    }
}
