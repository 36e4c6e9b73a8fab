//! Formats questions and values as text for reports.

pub mod answer;

use protocol::{AnyTable, Interval, Question, Record, Value};

use crate::types;

pub use types::{interval, number, one_or_count, point, shapes as each_shape, span, uv};

/// Describes one element of a question. An element is a row of a table (described together with the
/// table's subject), a tree, or a picture.
pub fn element(question: &Question, element: usize) -> String {
    if let Question::Build {
        shapes,
        max_leaf_size,
    } = question
    {
        let shapes = one_or_count(shapes);
        return format!("build a tree over {shapes}, with at most {max_leaf_size} in each leaf");
    }
    if let Question::Radiance { film, samples, .. } = question {
        let (x, y) = (element as u32 % film.x, element as u32 / film.x);
        return format!(
            "pixel ({x}, {y}) of a rendered picture of {}×{} pixels with {samples} samples each",
            film.x, film.y
        );
    }
    let table = question.table();
    table.map_or_else(String::new, |table| row(table, element))
}

/// Describes all elements of a question together.
pub fn all_elements(question: &Question) -> String {
    let name = question.table().map_or("the method", AnyTable::name);
    format!("{} calls to {name}", question.count())
}

fn row(table: &dyn AnyTable, row: usize) -> String {
    let input = table.input(row);
    let records: Vec<&dyn Record> = input
        .as_deref()
        .into_iter()
        .chain([table.subject()])
        .collect();
    let text = fill(table.sentence(), &records);
    let has_pixel = |record: &&dyn Record| record.names().contains(&"pixel");
    match table.film() {
        Some(film) if !records.iter().any(has_pixel) => {
            let pixel = row / protocol::PIXEL_OFFSETS.len();
            let (x, y) = (pixel as u32 % film.x, pixel as u32 / film.x);
            format!("pixel ({x}, {y}) of a picture, {text}")
        }
        Some(_) | None => text,
    }
}

/// Replaces each `{name}` in a sentence with the field of this name, and `{ray}` with the fields of
/// a ray. Placeholders for missing fields are removed.
fn fill(sentence: &str, records: &[&dyn Record]) -> String {
    let field = |name: &str| {
        records.iter().find_map(|record| {
            let index = record.names().iter().position(|other| *other == name)?;
            Some(record.value(index))
        })
    };
    let text = |value: Value| types::of(&value).text();
    let ray = || {
        let (origin, direction) = (text(field("origin")?), text(field("direction")?));
        let within = match field("range") {
            Some(Value::Range(range)) if range != Interval::AHEAD => {
                format!(" within {}", interval(range))
            }
            _ => String::new(),
        };
        Some(format!("ray from {origin} toward {direction}{within}"))
    };
    let mut parts = sentence.split('{');
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once('}').unwrap_or((part, ""));
        let value = match name {
            "ray" => ray(),
            name => field(name).map(text),
        };
        filled += &value.unwrap_or_default();
        filled += rest;
    }
    filled
}
