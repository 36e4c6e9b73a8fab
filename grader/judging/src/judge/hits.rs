//! Compares tables of hits with the key.

use protocol::{ElementOutcome, Ray, Shape, Trace};

use crate::describe;
use crate::exam::{ExpectedHit, HitCheck};
use crate::judge::quantity::Quantity;
use crate::judge::{Deviation, FailureKind, Table, scale};

/// The submitted hits and their key. Every hit must be correct.
pub(super) struct Hits<'a> {
    pub(super) checks: &'a [HitCheck],
    pub(super) shapes: &'a [Shape],
    pub(super) rays: Vec<Ray>,
    pub(super) hits: &'a [Option<ExpectedHit>],
    pub(super) answers: &'a [ElementOutcome<Option<Trace>>],
}

impl Table for Hits<'_> {
    type Value = Option<Trace>;

    fn outcomes(&self) -> &[ElementOutcome<Option<Trace>>] {
        self.answers
    }

    fn count(&self) -> usize {
        self.hits.len()
    }

    fn deviations(&self, element: usize, got: &Option<Trace>) -> Vec<Deviation> {
        let (ray, hit) = (&self.rays[element], &self.hits[element]);
        match (got, hit) {
            (None, None) => Vec::new(),
            (Some(_), None) | (None, Some(_)) => vec![Deviation::WRONG],
            (Some(got), Some(hit)) => {
                let scale = scale::of_hit(self.shapes, ray, Some(hit.distance));
                let wanted = hit.to_trace(ray);
                let deviation = |check: &HitCheck| {
                    let quantity = |trace| Quantity::of_hit(*check, trace);
                    quantity(got).deviation(quantity(&wanted), scale)
                };
                self.checks.iter().map(deviation).collect()
            }
        }
    }

    fn failure(&self, element: usize, got: &Option<Trace>, check: usize) -> FailureKind {
        match (got, &self.hits[element]) {
            (Some(got), Some(hit)) => {
                let quantity = |trace| Quantity::of_hit(self.checks[check], trace);
                quantity(got).failure(quantity(&hit.to_trace(&self.rays[element])))
            }
            (got, wanted) => {
                let text =
                    |distance: Option<f32>| distance.map_or("no hit".to_owned(), describe::hit_at);
                FailureKind::Wrong {
                    what: "hit or miss".to_owned(),
                    got: text(got.map(|trace| trace.distance)),
                    wanted: text(wanted.as_ref().map(|hit| hit.distance)),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use protocol::{Answer, Question, Rays};

    use super::*;
    use crate::exam::{ExamQuestion, Key};
    use crate::judge::judge;
    use crate::judge::measure::LENGTH;
    use crate::tests::{EXPECTED, sphere};

    #[test]
    fn an_error_is_judged_by_the_scale_of_its_ray() {
        for from in [8.0, 800.0] {
            // The ray is as short in both, but the coordinates are not as large.
            let hit = ExpectedHit {
                position: Vec3::X * (from - 1.0),
                ..EXPECTED
            };
            let ray = Ray::new(Vec3::X * from, -Vec3::X);
            let question = ExamQuestion::new(
                Question::Shapes {
                    shapes: vec![sphere(Vec3::X * (from - 2.0), 1.0)],
                    rays: Rays::List(vec![ray]),
                },
                Key::Hits {
                    checks: vec![HitCheck::Distance],
                    hits: vec![Some(hit)],
                },
            );
            let is_right = |tolerances: f32| {
                let mut trace = hit.to_trace(&ray);
                trace.distance += tolerances * LENGTH * from;
                let answer = Answer::Hits(vec![ElementOutcome::Value(Some(trace))]);
                judge(&question, &answer).failure.is_none()
            };
            assert!(is_right(0.5), "from {from}");
            assert!(!is_right(1.5), "from {from}");
        }
    }
}
