//! The only field in which a call differs from the previous one.
//!
//! A function that keeps its last answer and compares only some of its arguments is wrong exactly
//! where one of the others changes.

use glam::Vec3;
use judging::exam::{ExamQuestion, Key};
use protocol::{Record, Value};

/// The name of the aspect. Its classes are the names of fields.
pub const NAME: &str = "only change since the previous call";

/// A row of a table, with the correct answer.
struct AnsweredCall<'a> {
    subject: &'a dyn Record,
    input: Box<dyn Record>,
    judged: &'a [String],
    answer: Option<Box<dyn Record>>,
}

/// For each call in a question, returns the index in `fields` of the only field in which it differs
/// from the previous call. Returns `None` for calls that differ in other ways or have the same
/// answer. `before` is the item's previous question.
pub fn only_changes(
    fields: &[&str],
    asked: &ExamQuestion,
    before: Option<&ExamQuestion>,
) -> Vec<Option<usize>> {
    let of_same_function = before.filter(|before| name(before) == name(asked));
    let mut previous = of_same_function.and_then(|before| calls(before).last());
    let changes = calls(asked).map(|call| {
        let previous_one = previous.as_ref();
        let field = previous_one.and_then(|previous| only_change(previous, &call));
        previous = Some(call);
        fields.iter().position(|name| Some(*name) == field)
    });
    changes.collect()
}

/// Returns whether the first two rows of a question have answers that differ by more than a
/// percent.
pub fn answers_differ(asked: &ExamQuestion) -> bool {
    let first: Vec<AnsweredCall> = calls(asked).take(2).collect();
    matches!(&first[..], [a, b] if differ(a, b))
}

/// Returns the name of the function that a question is about, if it is about one.
fn name(asked: &ExamQuestion) -> Option<&'static str> {
    asked.question.table().map(|table| table.name())
}

/// Returns the calls in a question. There are none if the answers aren't compared row by row.
fn calls(asked: &ExamQuestion) -> impl Iterator<Item = AnsweredCall<'_>> {
    let compared = match &asked.key {
        Key::Table { judged, rows, .. } => asked.question.table().zip(Some((judged, rows))),
        Key::Tree { .. }
        | Key::FirstHits { .. }
        | Key::SpreadEvenly { .. }
        | Key::Radiance { .. } => None,
    };
    compared.into_iter().flat_map(|(table, (judged, rows))| {
        (0..rows.count()).filter_map(move |row| {
            Some(AnsweredCall {
                subject: table.subject(),
                input: table.input(row)?,
                judged,
                answer: rows.record(row),
            })
        })
    })
}

/// Returns the name of the only field in which two calls differ, if their answers differ, too.
fn only_change(previous: &AnsweredCall, call: &AnsweredCall) -> Option<&'static str> {
    let is_same_subject = std::ptr::addr_eq(previous.subject, call.subject);
    let mut changes = Vec::new();
    if !is_same_subject {
        changes.extend(changed_fields(previous.subject, call.subject));
    }
    changes.extend(changed_fields(&*previous.input, &*call.input));
    let (name, is_of_same_size) = *changes.first()?;
    (changes.len() == 1 && is_of_same_size && differ(previous, call)).then_some(name)
}

/// Returns the names of the fields that differ, each with whether its two values have the same
/// size.
fn changed_fields(a: &dyn Record, b: &dyn Record) -> Vec<(&'static str, bool)> {
    let values = a.names().iter().zip(a.values().zip(b.values()));
    let changed = values.filter(|(_, (a, b))| a != b);
    changed
        .map(|(name, (a, b))| (*name, size(&a) == size(&b)))
        .collect()
}

/// Returns the number of lights in a list or of pixels in a map, which a function could compare
/// instead of the whole. Other values have no size.
fn size(value: &Value) -> Option<usize> {
    if let Value::Lights(lights) = value {
        Some(lights.len())
    } else if let Value::Map(map) = value {
        Some(map.pixels.len())
    } else {
        None
    }
}

/// Returns whether the answers to two calls differ in a judged quantity, by more than a percent.
fn differ(a: &AnsweredCall, b: &AnsweredCall) -> bool {
    let (Some(first), Some(second)) = (&a.answer, &b.answer) else {
        return a.answer.is_some() != b.answer.is_some();
    };
    let names = first.names().iter().enumerate();
    let mut judged = names.filter(|(_, name)| a.judged.iter().any(|judged| judged == *name));
    judged.any(|(index, _)| {
        let [x, y] = [first, second].map(|answer| components(&answer.value(index)));
        let largest = x.abs().max(y.abs()).max_element();
        (x - y).abs().max_element() > 0.01 * largest
    })
}

/// Returns the components of a value in an answer. A number is repeated.
fn components(value: &Value) -> Vec3 {
    if let Value::Direction(vector) | Value::Color(vector) = *value {
        vector
    } else if let Value::Density(number) | Value::Fraction(number) = *value {
        Vec3::splat(number)
    } else if let Value::OptionalDensity(number) = *value {
        Vec3::splat(number.unwrap_or(-1.0))
    } else {
        Vec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use judging::exam::ExpectedRows;
    use protocol::light::LightQuestion;
    use protocol::light::specular::{GlassSample, Medium};
    use protocol::{Fraction, Table};

    use super::*;

    const FIELDS: &[&str] = &["out", "random", "ior"];

    /// Returns a question whose answers are these numbers.
    fn question(ior: f32, rows: &[(Vec3, f32, f32)]) -> ExamQuestion {
        let calls = rows
            .iter()
            .map(|&(out, random, _)| GlassSample { out, random });
        let table = Table::of_list(Medium { ior }, calls.collect());
        let answers = rows.iter().map(|&(_, _, fraction)| Fraction { fraction });
        let rows = ExpectedRows::Fractions(answers.collect());
        ExamQuestion::new(
            LightQuestion::GlassScatter(table).into(),
            Key::table(&["fraction"], rows),
        )
    }

    #[test]
    fn the_only_changed_field_is_found_if_the_answer_changes_too() {
        let first = question(1.5, &[(Vec3::X, 0.5, 0.1)]);
        let second = question(
            2.0,
            &[
                // Only the index has changed.
                (Vec3::X, 0.5, 0.2),
                (Vec3::Y, 0.5, 0.3),
                (Vec3::Y, 0.7, 0.4),
                // The answer stays the same.
                (Vec3::Y, 0.8, 0.4),
                // Two fields change.
                (Vec3::Z, 0.9, 0.5),
            ],
        );
        let changes = only_changes(FIELDS, &second, Some(&first));
        assert_eq!(changes, [Some(2), Some(0), Some(1), None, None]);
        assert_eq!(only_changes(FIELDS, &second, None)[0], None);
    }
}
