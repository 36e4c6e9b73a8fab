//! Points: positions in space.

use glam::Vec3;
use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, length, number};
use crate::symptom::Side;

pub(super) struct Point(pub(super) Vec3);

impl FieldType for Point {
    fn text(&self) -> String {
        text(self.0)
    }

    fn largest_coordinate(&self) -> Option<f32> {
        Some(largest_coordinate(self.0))
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Length)
    }

    fn error(&self, wanted: &Value, scale: f32) -> f64 {
        let Value::Point(wanted) = wanted else {
            return f64::INFINITY;
        };
        error(self.0, *wanted, scale)
    }

    fn side(&self, _: &Value) -> Option<Side> {
        self.0.is_nan().then_some(Side::NotANumber)
    }

    fn in_tolerances(&self, scale: f32) -> Vec<f32> {
        length::in_tolerances(&self.0.to_array(), scale)
    }
}

/// Formats a point, a vector or a colour.
pub fn text(value: Vec3) -> String {
    let [x, y, z] = value.to_array().map(number);
    format!("({x}, {y}, {z})")
}

/// Returns the largest absolute coordinate.
pub(crate) fn largest_coordinate(point: Vec3) -> f32 {
    point.abs().max_element()
}

/// Returns the distance of a position from the expected one, as a multiple of its tolerance, which
/// is relative to `scale`.
fn error(got: Vec3, wanted: Vec3, scale: f32) -> f64 {
    let limit = length::TOLERANCE * scale;
    in_units_of(limit.into(), got.distance(wanted).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_compared_relative_to_the_scale() {
        assert!(error(Vec3::X * 1.00005, Vec3::X, 1.0) <= 1.0);
        assert!(error(Vec3::X * 1.00005, Vec3::X, 0.1) > 1.0);
        let two = error(Vec3::X * 0.0002, Vec3::ZERO, 1.0);
        assert!((two - 2.0).abs() < 0.02, "{two}");
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(error(Vec3::splat(bad), Vec3::ONE, 1.0), f64::INFINITY);
        }
    }
}
