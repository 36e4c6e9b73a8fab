//! The items of the assignment `light`.
//!
//! Nearly all keys are computed by [`oracle::light`](crate::oracle::light). No question is close to
//! a decision, because a correct answer in single precision could then differ from the key.

mod direct;
mod environment;
mod groups;
mod lambertian;
mod lights;
mod path;
mod rooms;
mod specular;

use glam::{DVec3, Vec2};
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::{Color, Density, Fraction, LocalDirection, Question, Record, Scattered};

use super::AuthoredTask;
use crate::domains::light::fields;
use crate::domains::previous_call::answers_differ;
use crate::oracle::light::Scattered64;
use crate::seed::Rng;

/// The tasks of `light`, in grading order. Environment maps are last in the lecture, but questions
/// about direct light and paths need them.
pub static TASKS: &[&AuthoredTask] = &[
    &lambertian::TASK,
    &specular::TASK,
    &lights::TASK,
    &environment::TASK,
    &direct::TASK,
    &path::TASK,
];

/// The smallest margin of a question.
const MARGIN: f64 = 2e-3;

/// Returns a question that expects these rows.
fn table(question: impl Into<Question>, judged: &[&str], rows: ExpectedRows) -> ExamQuestion {
    ExamQuestion::new(question.into(), Key::table(judged, rows))
}

/// Returns a question about these calls and, before the last one, a few more: for each field, one
/// that differs from the call before it in this field only and has a different answer. A function
/// that keeps its last answer has to compare every field.
///
/// The values are those of the other calls. `is_clear` returns whether a call's answer doesn't
/// depend on rounding.
fn with_changes<I: Record + Clone>(
    mut calls: Vec<I>,
    ask: impl Fn(Vec<I>) -> ExamQuestion,
    is_clear: impl Fn(&I) -> bool,
) -> ExamQuestion {
    let end = calls.len().saturating_sub(1);
    let mut changed: Vec<I> = calls[..end].last().into_iter().cloned().collect();
    for field in calls.first().map_or(0..0, |call| 0..call.names().len()) {
        let Some(previous) = changed.last() else {
            break;
        };
        let next = calls.iter().find_map(|other| {
            let mut next = previous.clone();
            next.set(field, other.value(field));
            let asked = || ask(vec![previous.clone(), next.clone()]);
            (is_clear(&next) && answers_differ(&asked())).then_some(next)
        });
        changed.extend(next);
    }
    calls.splice(end..end, changed.into_iter().skip(1));
    ask(calls)
}

fn directions(rows: impl IntoIterator<Item = DVec3>) -> ExpectedRows {
    ExpectedRows::Directions(rows.into_iter().map(local).collect())
}

fn optional_directions(rows: impl IntoIterator<Item = Option<DVec3>>) -> ExpectedRows {
    let rows = rows.into_iter().map(|row| row.map(local));
    ExpectedRows::OptionalDirections(rows.collect())
}

fn colors(rows: impl IntoIterator<Item = DVec3>) -> ExpectedRows {
    let color = |value: DVec3| Color {
        value: value.as_vec3(),
    };
    ExpectedRows::Colors(rows.into_iter().map(color).collect())
}

fn densities(rows: impl IntoIterator<Item = f64>) -> ExpectedRows {
    let density = |pdf: f64| Density { pdf: pdf as f32 };
    ExpectedRows::Densities(rows.into_iter().map(density).collect())
}

fn fractions(rows: impl IntoIterator<Item = f64>) -> ExpectedRows {
    let fraction = |fraction: f64| Fraction {
        fraction: fraction as f32,
    };
    ExpectedRows::Fractions(rows.into_iter().map(fraction).collect())
}

fn scattered(rows: impl IntoIterator<Item = Scattered64>) -> ExpectedRows {
    let scattered = |row: Scattered64| Scattered {
        direction: row.direction.as_vec3(),
        attenuation: row.attenuation.as_vec3(),
        pdf: row.pdf.map(|pdf| pdf as f32),
    };
    ExpectedRows::Scattered(rows.into_iter().map(scattered).collect())
}

fn local(direction: DVec3) -> LocalDirection {
    LocalDirection {
        direction: direction.as_vec3(),
    }
}

/// Rounds a vector to single precision, so that the oracle gets the same numbers as the submission.
fn single(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

/// Returns a random direction above the surface, close neither to the horizon nor to the normal.
fn above(rng: &mut Rng) -> DVec3 {
    fields::direction(rng, 2)
}

/// Returns a random direction below the surface, close neither to the horizon nor to the normal.
fn below(rng: &mut Rng) -> DVec3 {
    -above(rng)
}

/// Returns a colour with a different value for each channel.
fn color(rng: &mut Rng) -> DVec3 {
    rng.retry(|rng| {
        let color = single(rng.vector(0.05, 0.95));
        let [r, g, b] = color.to_array();
        let gaps = [r - g, g - b, b - r].map(f64::abs);
        gaps.iter().all(|gap| *gap > 0.1).then_some(color)
    })
}

/// Returns a random number in `[0, 1)` in single precision.
fn random(rng: &mut Rng) -> f32 {
    // The largest numbers in single precision below 1 are 6e-8 apart.
    rng.uniform(0.0, 1.0 - 1e-7) as f32
}

/// Returns two random numbers in `[0, 1)` in single precision.
fn random_pair(rng: &mut Rng) -> Vec2 {
    Vec2::new(random(rng), random(rng))
}
