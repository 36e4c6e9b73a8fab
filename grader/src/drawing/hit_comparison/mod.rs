//! The expected and the submitted hit of a ray.

mod caption;

use glam::{DVec3, Vec3};
use protocol::{Answer, Interval, Question, Ray, Trace};

use judging::describe;
use judging::exam::{ExamQuestion, ExpectedRows, Key, Surface};

use super::value;

/// A placeholder for the shape number of an expected hit, used if the actual number is unknown
/// because the key belongs to a picture. No shape has this number.
const UNKNOWN_SHAPE: u32 = u32::MAX;

/// The field of a hit that the drawing shows: the first judged field that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::drawing) enum Focus {
    /// Whether there is a hit and, if so, its distance.
    Distance,
    /// The position, which may not be on the ray.
    Position,
    /// The normal, whose direction or length may be wrong.
    Normal,
    /// The texture coordinates.
    Uv,
    /// The origin of the ray, as stored in the hit.
    Origin,
    /// The number of the shape.
    Shape,
}

/// One ray of a question, with the expected and the submitted hit.
#[derive(Clone, Copy, Debug)]
pub(in crate::drawing) struct HitComparison {
    pub(in crate::drawing) ray: Ray,
    pub(in crate::drawing) wanted: Option<Trace>,
    /// The submission's answer: a hit, `None`, or no answer at all, for example because the code
    /// panicked.
    pub(in crate::drawing) got: Option<Option<Trace>>,
    pub(in crate::drawing) focus: Focus,
}

impl HitComparison {
    /// Compares one element of a question about rays. Returns `None` for any other question, for an
    /// element that doesn't exist, and for a ray whose origin isn't finite or whose direction is
    /// invalid.
    pub(in crate::drawing) fn new(
        question: &ExamQuestion,
        element: usize,
        answer: Option<&Answer>,
    ) -> Option<HitComparison> {
        let Question::Hit(table) = &question.question else {
            return None;
        };
        let ray = table.rows.get(element)?;
        let has_direction = ray.dir.is_finite() && ray.dir.length() > 0.0;
        if !(ray.origin.is_finite() && has_direction) {
            return None;
        }
        let (judged, wanted): (Vec<&str>, _) = match &question.key {
            Key::Table {
                judged,
                rows: ExpectedRows::Hits(hits),
                ..
            } => {
                let judged = judged.iter().map(String::as_str);
                (judged.collect(), *hits.get(element)?)
            }
            Key::FirstHits { hits, .. } => {
                let surface = hits.get(element)?.as_ref();
                (
                    vec!["distance", "normal", "uv"],
                    surface.map(|surface| trace_of(surface, &ray)),
                )
            }
            Key::Table { .. }
            | Key::Tree { .. }
            | Key::Radiance { .. }
            | Key::SpreadEvenly { .. } => return None,
        };
        let got = if let Some(Answer::Hits(hits)) = answer {
            value(hits, element).copied()
        } else {
            None
        };
        let focus = choose_focus(&judged, wanted.zip(got.flatten()));
        Some(HitComparison {
            ray,
            wanted,
            got,
            focus,
        })
    }

    /// Returns the submitted hit, if any.
    pub(in crate::drawing) fn got_hit(&self) -> Option<Trace> {
        self.got.flatten()
    }

    /// Returns the point where the submitted hit is drawn.
    pub(in crate::drawing) fn got_point(&self) -> Option<DVec3> {
        let hit = self.got_hit()?;
        Some(if self.focus == Focus::Position {
            hit.position.as_dvec3()
        } else {
            self.at(hit.distance.into())
        })
    }

    /// Returns the point on the ray at this distance.
    pub(in crate::drawing) fn at(&self, distance: f64) -> DVec3 {
        self.ray.origin.as_dvec3() + distance * self.dir()
    }

    /// Returns the direction of the ray, normalised.
    pub(in crate::drawing) fn dir(&self) -> DVec3 {
        self.ray.dir.as_dvec3().normalize()
    }

    /// Returns the range of the ray, or `None` if the range is everything ahead of the origin.
    pub(in crate::drawing) fn limited_range(&self) -> Option<Interval> {
        (self.ray.range != Interval::AHEAD).then_some(self.ray.range)
    }
}

fn choose_focus(judged: &[&str], hits: Option<(Trace, Trace)>) -> Focus {
    let Some((wanted, got)) = hits else {
        return Focus::Distance;
    };
    let is_wrong = |quantity: &&&str| match **quantity {
        "position" => vectors_differ(got.position.as_dvec3(), wanted.position),
        "normal" => vectors_differ(got.normal.as_dvec3().normalize(), wanted.normal),
        "unit_normal" => numbers_differ(got.normal.as_dvec3().length(), 1.0),
        "uv" => vectors_differ(got.uv.extend(0.0).as_dvec3(), wanted.uv.extend(0.0)),
        "origin" => vectors_differ(got.origin.as_dvec3(), wanted.origin),
        "shape" => got.shape != wanted.shape,
        _ => numbers_differ(got.distance.into(), wanted.distance.into()),
    };
    match judged.iter().find(is_wrong).or(judged.first()) {
        Some(&"position") => Focus::Position,
        Some(&("normal" | "unit_normal")) => Focus::Normal,
        Some(&"uv") => Focus::Uv,
        Some(&"origin") => Focus::Origin,
        Some(&"shape") => Focus::Shape,
        Some(_) | None => Focus::Distance,
    }
}

/// Returns whether two numbers differ noticeably. This only decides which field is drawn. The judge
/// uses smaller tolerances.
fn numbers_differ(a: f64, b: f64) -> bool {
    let is_close = (a - b).abs() <= 1e-4 * b.abs().max(1.0);
    !is_close
}

fn vectors_differ(a: DVec3, b: Vec3) -> bool {
    numbers_differ(a.distance(b.as_dvec3()), 0.0)
}

fn trace_of(surface: &Surface, ray: &Ray) -> Trace {
    Trace {
        distance: surface.depth,
        position: ray.at(surface.depth),
        normal: surface.normal,
        uv: surface.uv,
        origin: ray.origin,
        shape: UNKNOWN_SHAPE,
    }
}

/// Returns a label with the distance to a hit.
pub(in crate::drawing) fn hit_text(hit: &Trace) -> String {
    format!("a hit at {}", describe::number(hit.distance))
}
