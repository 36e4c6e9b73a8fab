//! The types of fields: how values of each type are compared, printed and observed. Each type has
//! its own file, and all functions use the same types.

mod asked;
pub(crate) mod direction;
mod index;
mod interval;
pub(crate) mod length;
pub(crate) mod multiple;
mod number;
pub(crate) mod point;
mod range;
mod shapes;
mod unit_length;
pub(crate) mod uv;

use protocol::Value;

pub use interval::{optional_text as span, text as interval};
pub use number::number;
pub use point::text as point;
pub use shapes::{one_or_count, text as shapes};
pub use uv::text as uv;

pub(crate) use unit_length::UnitLength;

/// The type of a field.
pub(crate) trait FieldType {
    /// Returns the value as text.
    fn text(&self) -> String;

    /// Returns the largest coordinate, if the value is a position in space. Lengths are
    /// compared relative to the largest one in a question.
    fn largest_coordinate(&self) -> Option<f32> {
        None
    }

    /// Returns the tolerance of values of this type, or `None` if they are either equal or wrong.
    fn tolerance(&self) -> Option<Tolerance> {
        None
    }

    /// Returns the error of the value, as a multiple of the tolerance. Never NaN, and infinite if
    /// the values cannot be compared. `scale` is the question's.
    fn error(&self, _wanted: &Value, _scale: f32) -> f64 {
        f64::INFINITY
    }

    /// Returns the value as multiples of its tolerance.
    fn in_tolerances(&self, _scale: f32) -> Vec<f32> {
        Vec::new()
    }
}

/// The tolerance of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tolerance {
    /// The tolerance of lengths, relative to the question's scale.
    Length,
    /// The tolerance of unit vectors, as the length of their difference.
    Direction,
    /// The tolerance of texture coordinates.
    Uv,
}

/// Returns the type of a value.
pub(crate) fn of<'a>(value: &'a Value<'_>) -> Box<dyn FieldType + 'a> {
    match value {
        Value::Length(length) => Box::new(length::Length(*length)),
        Value::Point(point) => Box::new(point::Point(*point)),
        Value::Direction(direction) => Box::new(direction::Direction(*direction)),
        Value::Uv(uv) => Box::new(uv::Uv(*uv)),
        Value::Interval(times) => Box::new(interval::Times(*times)),
        Value::Range(range) => Box::new(range::Range(*range)),
        Value::Index(index) => Box::new(index::Index(*index)),
        Value::Shapes(list) => Box::new(shapes::Shapes(list)),
        Value::Count(_)
        | Value::Angle(_)
        | Value::Ratio(_)
        | Value::Film(_)
        | Value::Pixel(_)
        | Value::Offset(_)
        | Value::Nodes(_) => Box::new(asked::Asked(value)),
    }
}

#[cfg(test)]
mod tests;
