//! Types of fields that occur only in questions, never in answers.

use protocol::Value;

use super::number::random;
use super::{FieldType, light, number, uv};

pub(super) struct QuestionValue<'a>(pub(super) &'a Value<'a>);

impl FieldType for QuestionValue<'_> {
    fn text(&self) -> String {
        match self.0 {
            Value::Count(count) => count.to_string(),
            Value::Angle(number_of) | Value::Ratio(number_of) => number(*number_of),
            Value::Film(film) => format!("{}×{}", film.x, film.y),
            Value::Pixel(pixel) => format!("({}, {})", pixel.x, pixel.y),
            Value::Offset(offset) => uv(*offset),
            Value::Nodes(nodes) => nodes.len().to_string(),
            Value::Random(value) => random(*value),
            Value::RandomPair(pair) => format!("({}, {})", random(pair.x), random(pair.y)),
            Value::Lights(lights) => light::text(lights),
            Value::Scene(room) => light::room_text(room),
            Value::Map(map) => light::map_text(map),
            Value::Length(_)
            | Value::Point(_)
            | Value::Direction(_)
            | Value::Uv(_)
            | Value::Interval(_)
            | Value::Range(_)
            | Value::Index(_)
            | Value::Shapes(_)
            | Value::Color(_)
            | Value::Density(_)
            | Value::OptionalDensity(_)
            | Value::Fraction(_) => super::of(self.0).text(),
        }
    }
}
