//! The length of a direction, which should be one.

use glam::Vec3;
use protocol::Value;

use super::multiple::in_units_of;
use super::{FieldType, Tolerance, direction, number};

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
        in_units_of(direction::TOLERANCE.into(), error.into())
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        vec![self.0.length() / direction::TOLERANCE]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
