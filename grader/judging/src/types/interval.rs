//! Intervals: parts of a ray, whose ends are compared as lengths, and the ranges of rays, which are
//! compared exactly.

use protocol::{Interval, Value};

use super::length;
use super::{FieldType, Tolerance, number};
use crate::symptom::Side;

/// A part of a ray.
pub(super) struct Times(pub(super) Interval);

impl FieldType for Times {
    fn text(&self) -> String {
        text(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Length)
    }

    fn error(&self, wanted: &Value, scale: f32) -> f64 {
        let Value::Interval(wanted) = wanted else {
            return f64::INFINITY;
        };
        let error = |got, wanted| length::error(got, wanted, scale, length::TOLERANCE);
        error(self.0.min, wanted.min).max(error(self.0.max, wanted.max))
    }

    fn side(&self, _: &Value) -> Option<Side> {
        let ends = [self.0.min, self.0.max];
        ends.iter()
            .any(|end| end.is_nan())
            .then_some(Side::NotANumber)
    }

    fn in_tolerances(&self, scale: f32) -> Vec<f32> {
        length::in_tolerances(&[self.0.min, self.0.max], scale)
    }
}

/// The range of a ray.
pub(super) struct Range(pub(super) Interval);

impl FieldType for Range {
    fn text(&self) -> String {
        text(self.0)
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        if matches!(wanted, Value::Range(wanted) if self.0 == *wanted) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn in_tolerances(&self, scale: f32) -> Vec<f32> {
        // All mistakes that make the range finite should look alike.
        let Interval { min, max } = self.0;
        let end = if max.is_finite() { 0.0 } else { max };
        length::in_tolerances(&[min, end], scale)
    }
}

/// Formats an interval, or `None`.
pub fn optional_text(value: Option<Interval>) -> String {
    value.map_or("None".to_owned(), text)
}

/// Formats an interval of distances along a ray.
pub fn text(value: Interval) -> String {
    format!("[{}, {}]", number(value.min), number(value.max))
}
