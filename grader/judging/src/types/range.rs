//! Ranges of rays, whose ends may be infinite.

use protocol::{Interval, Value};

use super::{FieldType, Tolerance, interval, length};

pub(super) struct Range(pub(super) Interval);

impl FieldType for Range {
    fn text(&self) -> String {
        interval::text(self.0)
    }

    fn tolerance(&self) -> Option<Tolerance> {
        Some(Tolerance::Length)
    }

    fn error(&self, wanted: &Value, scale: f32) -> f64 {
        let Value::Range(wanted) = wanted else {
            return f64::INFINITY;
        };
        if self.0.max == wanted.max {
            length::error(self.0.min, wanted.min, scale, length::TOLERANCE)
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
