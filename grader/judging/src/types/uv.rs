//! Texture coordinates. Their u coordinate is periodic.

use glam::Vec2;
use protocol::Value;

use super::{FieldType, Tolerance, in_units_of, number};
use crate::symptom::Side;

/// Tolerance for texture coordinates.
pub(crate) const TOLERANCE: f32 = 2e-3;

pub(super) struct Uv(pub(super) Vec2);

impl FieldType for Uv {
    fn text(&self) -> String {
        text(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Uv)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        let Value::Uv(wanted) = wanted else {
            return f64::INFINITY;
        };
        error(self.0, *wanted)
    }

    fn side(&self, _: &Value) -> Option<Side> {
        self.0.is_nan().then_some(Side::NotANumber)
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        (self.0 / TOLERANCE).to_array().to_vec()
    }
}

/// Formats texture coordinates.
pub fn text(value: Vec2) -> String {
    format!("({}, {})", number(value.x), number(value.y))
}

/// Returns the error of texture coordinates, taking into account that u wraps around.
pub(crate) fn error(got: Vec2, wanted: Vec2) -> f64 {
    let u = (got.x - wanted.x).abs();
    // A difference of exactly one turn isn't an error. A larger difference is, because u must be
    // between 0 and 1.
    let u = u.min((1.0 - u).abs());
    let v = (got.y - wanted.y).abs();
    let error = |error: f32| in_units_of(TOLERANCE.into(), error.into());
    error(u).max(error(v))
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;

    #[test]
    fn u_wraps_around_but_v_does_not() {
        assert!(error(vec2(0.9995, 0.5), vec2(0.0005, 0.5)) <= 1.0);
        assert!(error(vec2(0.5, 0.9995), vec2(0.5, 0.0005)) > 1.0);
        let half = error(vec2(0.5, 0.5), vec2(0.501, 0.5));
        assert!((half - 0.5).abs() < 0.005, "{half}");
    }

    #[test]
    fn non_finite_values_are_infinitely_far_off() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(error(vec2(bad, 0.5), vec2(0.5, 0.5)), f64::INFINITY);
            assert_eq!(error(vec2(0.5, bad), vec2(0.5, 0.5)), f64::INFINITY);
        }
    }
}
