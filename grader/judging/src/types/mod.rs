//! The types of fields: how values of each type are compared, printed and observed. Similar types
//! share a file, and all functions use the same types.

mod color;
pub(crate) mod direction;
mod index;
mod interval;
pub(crate) mod length;
mod light;
mod number;
pub(crate) mod point;
pub(crate) mod portion;
mod question_value;
mod shapes;
pub(crate) mod uv;

use protocol::Value;

use crate::symptom::Side;

use portion::Portion;

pub use interval::{optional_text as span, text as interval};
pub use number::number;
pub use point::text as point;
pub use shapes::{one_or_count, text as shapes};
pub use uv::text as uv;

pub(crate) use direction::UnitLength;

/// The type of a field.
pub(crate) trait FieldType {
    /// Returns the value as text.
    fn text(&self) -> String;

    /// Returns the largest coordinate, if the value is a position in space. Lengths are compared
    /// relative to the largest coordinate in a question.
    fn largest_coordinate(&self) -> Option<f32> {
        None
    }

    /// Returns the tolerance for values of this type, or `None` if they are either equal or wrong.
    fn tolerance(&self) -> Option<Tolerance> {
        None
    }

    /// Returns the error of the value, as a multiple of the tolerance. Never NaN, and infinite if
    /// the values cannot be compared. `scale` is the scale of the question.
    fn error(&self, _wanted: &Value, _scale: f32) -> f64 {
        f64::INFINITY
    }

    /// Returns whether the value is smaller than expected, larger, or reversed, where its type
    /// allows this.
    fn side(&self, _wanted: &Value) -> Option<Side> {
        None
    }

    /// Returns the numbers in the value as multiples of its tolerance.
    fn in_tolerances(&self, _scale: f32) -> Vec<f32> {
        Vec::new()
    }
}

/// The tolerance for a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tolerance {
    /// The tolerance for lengths, relative to the question's scale.
    Length,
    /// The tolerance for unit vectors, which limits the length of their difference.
    Direction,
    /// The tolerance for texture coordinates.
    Uv,
    /// The tolerance for colours, densities and fractions, relative to the expected value.
    Relative,
}

/// Returns the type of a value.
pub(crate) fn of<'a>(value: &'a Value<'_>) -> Box<dyn FieldType + 'a> {
    match value {
        Value::Length(length) => Box::new(length::Length(*length)),
        Value::Point(point) => Box::new(point::Point(*point)),
        Value::Direction(direction) => Box::new(direction::Direction(*direction)),
        Value::Uv(uv) => Box::new(uv::Uv(*uv)),
        Value::Interval(times) => Box::new(interval::Times(*times)),
        Value::Range(range) => Box::new(interval::Range(*range)),
        Value::Index(index) => Box::new(index::Index(*index)),
        Value::Shapes(list) => Box::new(shapes::Shapes(list)),
        Value::Color(color) => Box::new(color::Color(*color)),
        Value::Density(_) | Value::OptionalDensity(_) | Value::Fraction(_) => {
            Box::new(Portion(value))
        }
        Value::Count(_)
        | Value::Angle(_)
        | Value::Ratio(_)
        | Value::Film(_)
        | Value::Pixel(_)
        | Value::Offset(_)
        | Value::Nodes(_)
        | Value::Random(_)
        | Value::RandomPair(_)
        | Value::Lights(_)
        | Value::Scene(_)
        | Value::Map(_) => Box::new(question_value::QuestionValue(value)),
    }
}

/// Returns `error` as a multiple of `limit`. Never NaN: the error of values that cannot be compared
/// is infinite.
pub(crate) fn in_units_of(limit: f64, error: f64) -> f64 {
    // An error of 0 is accepted even if the limit is 0.
    if error <= 0.0 {
        return 0.0;
    }
    let multiple = error / limit;
    if multiple.is_nan() {
        f64::INFINITY
    } else {
        multiple
    }
}

#[cfg(test)]
mod tests;
