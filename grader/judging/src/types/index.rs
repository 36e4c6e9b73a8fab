//! Shape and node numbers, which are either equal or wrong.

use protocol::Value;

use super::{FieldType, direction};

pub(super) struct Index(pub(super) u32);

impl FieldType for Index {
    fn text(&self) -> String {
        self.0.to_string()
    }

    fn error(&self, wanted: &Value, _: f32) -> f64 {
        if *wanted == Value::Index(self.0) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn in_tolerances(&self, _: f32) -> Vec<f32> {
        // Keeps different numbers far apart.
        vec![self.0 as f32 / direction::TOLERANCE]
    }
}
