//! Reduces answers to observations, by which known mistakes are recognised.
//!
//! Numbers are observed as multiples of the tolerances with which they are judged, so that a small
//! scene does not make all mistakes look alike.

mod tree;

use protocol::{Answer, ElementOutcome, Interval, Question, Ray, Rays, Trace, Tree};

use crate::exam::{ExamQuestion, HitCheck, Item, Key, RayCheck};
use crate::judge::quantity::{Quantity, lengths_in_tolerances};
use crate::judge::rays::expected_ray;
use crate::judge::scale;
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
        Key::Rays { checks, directions } => {
            let rays = directions.iter().map(|dir| expected_ray(*dir));
            rays.map(|ray| observe_ray(checks, &ray)).collect()
        }
        Key::Hits { checks, .. } => {
            let traces = expected_traces(question);
            let scaled = traces.iter().zip(scales(question));
            scaled
                .map(|(trace, scale)| observe_checked(checks, trace.as_ref(), scale))
                .collect()
        }
        Key::Spans { spans } => {
            let spans = spans.iter().zip(scales(question));
            spans
                .map(|(span, scale)| observe_span(*span, scale))
                .collect()
        }
        Key::Tree { .. } => vec![ObservedAnswer::Tree(None)],
        Key::FirstHits { .. } | Key::Radiance { .. } => Vec::new(),
    }
}

fn observe_question(question: &ExamQuestion, answer: &Answer) -> Vec<ObservedAnswer> {
    match (&question.key, answer) {
        (Key::Rays { checks, .. }, Answer::Rays(rays)) => {
            observe_each(rays, |_, ray| observe_ray(checks, ray))
        }
        (Key::Hits { checks, .. }, Answer::Hits(hits)) => {
            let (scales, traces) = (scales(question), expected_traces(question));
            observe_each(hits, |element, hit| {
                let scale = scales.get(element).copied().unwrap_or(1.0);
                let expected = traces.get(element).and_then(Option::as_ref);
                observe_hit(checks, hit.as_ref(), expected, scale)
            })
        }
        (Key::Spans { .. }, Answer::Spans(spans)) => {
            let scales = scales(question);
            let scale = |element: usize| scales.get(element).copied().unwrap_or(1.0);
            observe_each(spans, |element, span| observe_span(*span, scale(element)))
        }
        (Key::Tree { .. }, Answer::Tree(tree)) => {
            observe_each(std::slice::from_ref(tree), |_, tree| {
                observe_tree(question, tree)
            })
        }
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. },
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
        // Elements are skipped after panics.
        ElementOutcome::Skipped => last_panic.clone().unwrap_or(ObservedAnswer::Panicked),
    });
    observed.collect()
}

/// Returns the scale of each element.
fn scales(question: &ExamQuestion) -> Vec<f32> {
    match (&question.key, &question.question) {
        (Key::Hits { hits, .. }, asked) => {
            let hits = hits
                .iter()
                .zip(asked.rays().into_iter().flat_map(Rays::to_vec));
            hits.map(|(hit, ray)| {
                let distance = hit.as_ref().map(|hit| hit.distance);
                scale::of_hit(scale::shapes(asked), &ray, distance)
            })
            .collect()
        }
        (Key::Spans { .. }, Question::BBox { min, max, queries }) => {
            let queries = queries.iter();
            queries
                .map(|(ray, _)| scale::of_box(*min, *max, ray))
                .collect()
        }
        (
            Key::Rays { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. },
            _,
        ) => Vec::new(),
    }
}

fn observe_ray(checks: &[RayCheck], ray: &Ray) -> ObservedAnswer {
    let numbers = |check: &RayCheck| Quantity::of_ray(*check, ray).in_tolerances(1.0);
    ObservedAnswer::Numbers(checks.iter().flat_map(numbers).collect())
}

/// Returns the correct hit of each ray.
fn expected_traces(question: &ExamQuestion) -> Vec<Option<Trace>> {
    let Key::Hits { hits, .. } = &question.key else {
        return Vec::new();
    };
    let rays = question.question.rays().into_iter().flat_map(Rays::to_vec);
    let hits = hits.iter().zip(rays);
    hits.map(|(hit, ray)| Some(hit.as_ref()?.to_trace(&ray)))
        .collect()
}

/// Observes a hit. From a wrong distance, correct code computes a wrong position, normal and uv in one
/// way or another: a normal may still be of length one, or not. So only the distance is observed then.
fn observe_hit(
    checks: &[HitCheck],
    trace: Option<&Trace>,
    expected: Option<&Trace>,
    scale: f32,
) -> ObservedAnswer {
    let observe = |checks: &[HitCheck], trace| observe_checked(checks, trace, scale);
    let is_correct = |checks| observe(checks, trace).matches(&observe(checks, expected));
    let distance = [HitCheck::Distance];
    let follows_from_distance = !is_correct(checks) && !is_correct(&distance);
    observe(
        if follows_from_distance {
            &distance
        } else {
            checks
        },
        trace,
    )
}

fn observe_checked(checks: &[HitCheck], trace: Option<&Trace>, scale: f32) -> ObservedAnswer {
    let Some(trace) = trace else {
        return ObservedAnswer::NoHit;
    };
    let numbers = |check: &HitCheck| Quantity::of_hit(*check, trace).in_tolerances(scale);
    ObservedAnswer::Numbers(checks.iter().flat_map(numbers).collect())
}

fn observe_span(span: Option<Interval>, scale: f32) -> ObservedAnswer {
    span.map_or(ObservedAnswer::NoHit, |span| {
        ObservedAnswer::Numbers(lengths_in_tolerances(&[span.min, span.max], scale))
    })
}

/// Returns the defect that the judge finds in a tree.
fn observe_tree(question: &ExamQuestion, tree: &Tree) -> ObservedAnswer {
    match (&question.key, &question.question) {
        (
            Key::Tree { checks, sweep_cost },
            Question::Build {
                shapes,
                max_leaf_size,
            },
        ) => {
            let criteria = TreeCriteria {
                checks,
                sweep_cost: *sweep_cost,
                shapes,
                max_leaf_size: *max_leaf_size,
            };
            let defect = criteria.defect(tree);
            ObservedAnswer::Tree(defect.map(|defect| tree::defect(shapes, tree, &defect)))
        }
        _ => ObservedAnswer::NoAnswer(NoAnswerReason::Other),
    }
}

#[cfg(test)]
mod tests;
