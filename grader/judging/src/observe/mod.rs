//! Reduces answers to observations, which are used to recognise known mistakes.
//!
//! Numbers are observed as multiples of their tolerances, so that mistakes don't all look alike in
//! a small scene.

mod tree;

use protocol::{Answer, ElementOutcome, Record, Tree};

use crate::exam::{ExamQuestion, Item, Key};
use crate::judge::quantity::Quantity;
use crate::judge::table::{ExpectedTable, Row, TableAnswer};
use crate::judge::tree::TreeCriteria;
use crate::signatures::{NoAnswerReason, ObservedAnswer};

/// Reduces the answers to an item to observations, one for each element.
pub fn observe(item: &Item, answers: &[Answer]) -> Vec<ObservedAnswer> {
    let questions = item.questions.iter().zip(answers);
    questions
        .flat_map(|(question, answer)| observe_question(question, answer))
        .collect()
}

/// Returns the observations that correct answers would give, one for each element of an item.
pub fn expected(item: &Item) -> Vec<ObservedAnswer> {
    item.questions.iter().flat_map(expected_elements).collect()
}

fn expected_elements(question: &ExamQuestion) -> Vec<ObservedAnswer> {
    match &question.key {
        Key::Table { .. } => ExpectedTable::new(question).map_or(Vec::new(), |table| {
            let observe = |(record, scale): &(Option<Box<dyn Record>>, f32)| {
                observe_record(&table.judged, record.as_deref(), *scale)
            };
            table.rows.iter().map(observe).collect()
        }),
        Key::Tree { .. } => vec![ObservedAnswer::Tree(None)],
        Key::FirstHits { .. } | Key::Radiance { .. } | Key::SpreadEvenly { .. } => Vec::new(),
    }
}

fn observe_question(question: &ExamQuestion, answer: &Answer) -> Vec<ObservedAnswer> {
    match (&question.key, answer) {
        (Key::Table { .. }, _) => TableAnswer::new(question, answer).map_or(Vec::new(), |table| {
            observe_each(table.rows(), |index, got| {
                observe_row(table.judged(), &table.row(index, *got))
            })
        }),
        (Key::Tree { .. }, Answer::Tree(tree)) => {
            observe_each(std::slice::from_ref(tree), |_, tree| {
                observe_tree(question, tree)
            })
        }
        (
            Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. }
            | Key::SpreadEvenly { .. },
            _,
        ) => Vec::new(),
    }
}

fn observe_each<T>(
    outcomes: &[ElementOutcome<T>],
    see: impl Fn(usize, &T) -> ObservedAnswer,
) -> Vec<ObservedAnswer> {
    let panics = outcomes.iter().filter_map(|outcome| match outcome {
        ElementOutcome::Panicked(panic) => Some(ObservedAnswer::of_panic(&panic.message)),
        ElementOutcome::Value(_) | ElementOutcome::Skipped => None,
    });
    let last_panic = panics.last();
    let outcomes = outcomes.iter().enumerate();
    let observed = outcomes.map(|(element, outcome)| match outcome {
        ElementOutcome::Value(value) => see(element, value),
        ElementOutcome::Panicked(panic) => ObservedAnswer::of_panic(&panic.message),
        // Elements are only skipped after panics.
        ElementOutcome::Skipped => last_panic.clone().unwrap_or(ObservedAnswer::Panicked),
    });
    observed.collect()
}

/// Observes a row. If the distance is wrong, only the distance is observed: position, normal and uv
/// are then wrong too, and how they are wrong depends on how the code is written (e.g. whether it
/// normalises the normal), not on the mistake.
fn observe_row(judged: &[Quantity], row: &Row) -> ObservedAnswer {
    let observe = |judged: &[Quantity], record| observe_record(judged, record, row.scale);
    let is_correct = |judged: &[Quantity]| {
        observe(judged, row.got).matches(&observe(judged, row.wanted.as_deref()))
    };
    let distance = row.got.and_then(Quantity::first_length);
    let distance = distance.as_ref().map(std::slice::from_ref);
    let wrong_distance = distance.filter(|distance| !is_correct(judged) && !is_correct(distance));
    observe(wrong_distance.unwrap_or(judged), row.got)
}

fn observe_record(judged: &[Quantity], record: Option<&dyn Record>, scale: f32) -> ObservedAnswer {
    let Some(record) = record else {
        return ObservedAnswer::NoHit;
    };
    let numbers = |quantity: &Quantity| quantity.in_tolerances(record, scale);
    ObservedAnswer::Numbers(judged.iter().flat_map(numbers).collect())
}

/// Returns the defect the judge finds in a tree.
fn observe_tree(question: &ExamQuestion, tree: &Tree) -> ObservedAnswer {
    let Some(criteria) = TreeCriteria::of(question) else {
        return ObservedAnswer::NoAnswer(NoAnswerReason::Other);
    };
    let defect = criteria.defect(tree);
    ObservedAnswer::Tree(defect.map(|defect| tree::defect(criteria.shapes, tree, &defect)))
}

#[cfg(test)]
mod tests;
