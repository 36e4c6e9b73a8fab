//! Answers derived from the keys of the practice exam, and errors to insert into their elements.

use std::sync::LazyLock;

use glam::Vec3;
use protocol::{Answer, ElementOutcome, Interval, Panic};

use super::{EXAM, HIT};
use crate::exam::ExamQuestion;

/// The questions, each with the answer derived from its key. Trees are left out because many
/// different trees are correct.
pub static QUESTIONS: LazyLock<Vec<(&ExamQuestion, Answer)>> = LazyLock::new(|| {
    let questions = EXAM.items.iter().flat_map(|item| &item.questions);
    questions
        .filter_map(|question| Some((question, question.key.answer()?)))
        .collect()
});

/// A kind of error in an element.
#[derive(Clone, Copy, Debug)]
pub enum Error {
    /// Numbers are too large by this fraction.
    Relative(f32),
    NotANumber,
    Panicked,
}

impl Error {
    fn number(self, number: f32) -> f32 {
        match self {
            Error::Relative(error) => number * (1.0 + error),
            Error::NotANumber | Error::Panicked => f32::NAN,
        }
    }

    fn vector(self, vector: Vec3) -> Vec3 {
        vector.map(|number| self.number(number))
    }

    fn spoil<T>(self, outcome: &mut ElementOutcome<T>, spoil: impl FnOnce(&mut T)) {
        match outcome {
            _ if matches!(self, Error::Panicked) => {
                *outcome = ElementOutcome::Panicked(Panic {
                    message: "index out of bounds".to_owned(),
                    location: "sphere.rs:1".to_owned(),
                });
            }
            ElementOutcome::Value(value) => spoil(value),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => {}
        }
    }

    /// Introduces an error of this kind into one element of a correct answer.
    pub fn apply(self, answer: &mut Answer, index: usize) {
        match answer {
            Answer::Rays(rays) => self.spoil(&mut rays[index], |ray| {
                ray.origin = self.vector(Vec3::ONE) - 1.0;
                ray.dir.x = self.number(ray.dir.x + 1.0) - 1.0;
                ray.range.min = self.number(1.0) - 1.0;
            }),
            Answer::Hits(hits) => self.spoil(&mut hits[index], |hit| match hit {
                Some(trace) => {
                    trace.distance = self.number(trace.distance);
                    trace.position = self.vector(trace.position);
                    trace.normal.x = self.number(trace.normal.x + 1.0) - 1.0;
                    trace.uv.y = self.number(trace.uv.y + 1.0) - 1.0;
                    trace.origin = self.vector(trace.origin);
                    trace.shape = trace.shape.wrapping_add(1);
                }
                None => *hit = Some(HIT),
            }),
            Answer::Spans(spans) => self.spoil(&mut spans[index], |span| match span {
                Some(times) => times.max = self.number(times.max),
                None => *span = Some(Interval::new(0.0, 1.0)),
            }),
            Answer::Directions(all) => self.spoil(&mut all[index], |local| {
                local.direction = self.vector(local.direction);
            }),
            Answer::OptionalDirections(all) => self.spoil(&mut all[index], |local| {
                if let Some(local) = local {
                    local.direction = self.vector(local.direction);
                }
            }),
            Answer::Scattered(all) => self.spoil(&mut all[index], |scattered| {
                scattered.attenuation = self.vector(scattered.attenuation);
            }),
            Answer::Colors(all) => self.spoil(&mut all[index], |color| {
                color.value = self.vector(color.value);
            }),
            Answer::Densities(all) => self.spoil(&mut all[index], |density| {
                density.pdf = self.number(density.pdf);
            }),
            Answer::Fractions(all) => self.spoil(&mut all[index], |fraction| {
                fraction.fraction = self.number(fraction.fraction);
            }),
            Answer::Picture(outcome) => self.spoil(outcome, |pixels| {
                pixels[index] = self.vector(pixels[index] + 1.0) - 1.0;
            }),
            Answer::Tree(_) => unreachable!("a tree has no elements"),
        }
    }
}

pub fn count(answer: &Answer) -> usize {
    match (answer, answer.rows()) {
        (_, Some(rows)) => rows.len(),
        (Answer::Picture(ElementOutcome::Value(pixels)), None) => pixels.len(),
        (_, None) => unreachable!("this is not the key's answer to anything"),
    }
}
