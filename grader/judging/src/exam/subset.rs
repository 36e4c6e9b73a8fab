//! Selects some elements of a question and its key.

use std::ops::Range;

use protocol::Question;

use super::{Aggregate, Key};

/// Returns a question with only these elements. A question with a single element, such as a tree or
/// a rendered picture, is returned unchanged.
pub fn question_subset(question: &Question, elements: Range<usize>) -> Question {
    question
        .table()
        .map_or_else(|| question.clone(), |table| table.subset(elements))
}

/// Returns the key of one element. A key with a single element is returned unchanged.
pub(super) fn single_key(key: &Key, element: usize) -> Key {
    match key {
        Key::Table { judged, rows, .. } => Key::Table {
            judged: judged.clone(),
            rows: rows.single(element),
            aggregate: Aggregate::EveryRow,
        },
        Key::FirstHits { hits, alternatives } => Key::FirstHits {
            hits: vec![hits[element]],
            alternatives: alternatives
                .iter()
                .filter(|(position, _)| *position as usize == element)
                .map(|(_, surface)| (0, *surface))
                .collect(),
        },
        // A single direction isn't spread in any way, but it must have length one.
        Key::SpreadEvenly { .. } => Key::SpreadEvenly {
            max_chi_squared: f64::INFINITY,
        },
        Key::Tree { .. } | Key::Radiance { .. } => key.clone(),
    }
}
