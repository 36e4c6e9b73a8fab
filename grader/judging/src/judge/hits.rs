//! Compares tables of hits with the key.

use protocol::{ElementOutcome, Ray, Shape, Trace};

use crate::describe;
use crate::exam::{ExpectedHit, HitCheck};
use crate::judge::measure::{
    DIRECTION, LENGTH, direction_error, length_error, point_error, unit_error, uv_error,
};
use crate::judge::{
    Comparison, Deviation, FailureKind, Judgement, Measurement, Threshold, judge_table,
    measure_table, scale,
};

/// The submitted hits and their key. Every hit must be correct.
pub(super) struct Hits<'a> {
    pub(super) checks: &'a [HitCheck],
    pub(super) shapes: &'a [Shape],
    pub(super) rays: Vec<Ray>,
    pub(super) hits: &'a [Option<ExpectedHit>],
    pub(super) answers: &'a [ElementOutcome<Option<Trace>>],
}

impl Comparison for Hits<'_> {
    fn judge(&self) -> Judgement {
        judge_table(self.answers, self.hits.len(), |element, got| {
            match (got, &self.hits[element]) {
                (None, None) => None,
                (Some(trace), None) => Some(FailureKind::Wrong {
                    what: "hit or miss".to_owned(),
                    got: describe::hit_at(trace.distance),
                    wanted: "no hit".to_owned(),
                }),
                (None, Some(hit)) => Some(FailureKind::Wrong {
                    what: "hit or miss".to_owned(),
                    got: "no hit".to_owned(),
                    wanted: describe::hit_at(hit.distance),
                }),
                (Some(trace), Some(hit)) => {
                    let (ray, scale) = (&self.rays[element], self.scale(element, hit));
                    let mut checks = self.checks.iter();
                    checks.find_map(|part| failed_check(*part, ray, scale, trace, hit))
                }
            }
        })
    }

    fn measure(&self) -> Vec<Measurement> {
        measure_table(self.answers, self.hits.len(), |element, got| {
            match (got, &self.hits[element]) {
                (None, None) => Vec::new(),
                (Some(_), None) | (None, Some(_)) => vec![Deviation::WRONG],
                (Some(trace), Some(hit)) => {
                    let (ray, scale) = (&self.rays[element], self.scale(element, hit));
                    let checks = self.checks.iter();
                    checks
                        .map(|part| deviation(*part, ray, scale, trace, hit))
                        .collect()
                }
            }
        })
    }
}

impl Hits<'_> {
    fn scale(&self, element: usize, hit: &ExpectedHit) -> f32 {
        scale::of_hit(self.shapes, &self.rays[element], Some(hit.distance))
    }
}

/// Returns how far one part of a traced hit deviates from the expected hit.
fn deviation(part: HitCheck, ray: &Ray, scale: f32, trace: &Trace, hit: &ExpectedHit) -> Deviation {
    let (threshold, error) = match part {
        HitCheck::Distance => (
            Threshold::Distance,
            length_error(trace.distance, hit.distance, scale, LENGTH),
        ),
        HitCheck::Position => (
            Threshold::Position,
            point_error(trace.position, hit.position, scale),
        ),
        HitCheck::Normal => (
            Threshold::Normal,
            direction_error(trace.normal, hit.normal, DIRECTION),
        ),
        HitCheck::UnitNormal => (Threshold::UnitLength, unit_error(trace.normal)),
        HitCheck::Uv => (Threshold::Uv, uv_error(trace.uv, hit.uv)),
        HitCheck::Origin => (
            Threshold::Origin,
            point_error(trace.origin, ray.origin, scale),
        ),
        HitCheck::Material => return Deviation::binary(trace.material == hit.material),
    };
    Deviation::new(threshold, error)
}

/// Returns the error in one part of a hit, or `None` if that part is correct.
fn failed_check(
    part: HitCheck,
    ray: &Ray,
    scale: f32,
    trace: &Trace,
    hit: &ExpectedHit,
) -> Option<FailureKind> {
    if deviation(part, ray, scale, trace, hit).is_right() {
        return None;
    }
    let (what, got, wanted) = match part {
        HitCheck::Distance => (
            "distance",
            describe::number(trace.distance),
            describe::number(hit.distance),
        ),
        HitCheck::Position => (
            "position",
            describe::point(trace.position),
            describe::point(hit.position),
        ),
        HitCheck::Normal => (
            "normal",
            describe::point(trace.normal),
            describe::point(hit.normal),
        ),
        HitCheck::UnitNormal => (
            "length of the normal",
            describe::number(trace.normal.length()),
            describe::number(1.0),
        ),
        HitCheck::Uv => ("uv", describe::uv(trace.uv), describe::uv(hit.uv)),
        HitCheck::Origin => (
            "origin",
            describe::point(trace.origin),
            describe::point(ray.origin),
        ),
        HitCheck::Material => (
            "material",
            trace.material.to_string(),
            hit.material.to_string(),
        ),
    };
    Some(FailureKind::Wrong {
        what: what.to_owned(),
        got,
        wanted,
    })
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};
    use protocol::{Answer, Question, Rays};

    use super::*;
    use crate::exam::{ExamQuestion, Key};
    use crate::judge::judge;

    #[test]
    fn an_error_is_judged_by_the_scale_of_its_ray() {
        for from in [8.0, 800.0] {
            // The ray is as short in both, but the coordinates are not as large.
            let hit = ExpectedHit {
                distance: 1.0,
                position: Vec3::X * (from - 1.0),
                normal: Vec3::X,
                uv: Vec2::ZERO,
                material: 0,
            };
            let ray = Ray::new(Vec3::X * from, -Vec3::X);
            let question = ExamQuestion::new(
                Question::Shapes {
                    shapes: vec![Shape::Sphere {
                        center: Vec3::X * (from - 2.0),
                        radius: 1.0,
                        material: 0,
                    }],
                    rays: Rays::List(vec![ray]),
                },
                Key::Hits {
                    checks: vec![HitCheck::Distance],
                    hits: vec![Some(hit)],
                },
            );
            let is_right = |tolerances: f32| {
                let trace = Trace {
                    distance: hit.distance + tolerances * LENGTH * from,
                    position: hit.position,
                    normal: hit.normal,
                    uv: hit.uv,
                    origin: ray.origin,
                    material: 0,
                };
                let answer = Answer::Hits(vec![ElementOutcome::Value(Some(trace))]);
                judge(&question, &answer).failure.is_none()
            };
            assert!(is_right(0.5), "from {from}");
            assert!(!is_right(1.5), "from {from}");
        }
    }
}
