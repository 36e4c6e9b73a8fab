//! A ray, what it should meet, and what the submission says that it meets.

mod sentence;

use glam::{DVec2, DVec3};
use protocol::{Answer, Interval, Outcome, Question, Ray, Trace};

use crate::exam::{Asked, Hit, Key, Part, Surface};

/// A meeting of a ray and a surface; the key of a picture does not tell all of it.
#[derive(Clone, Copy, Debug)]
pub(in crate::drawing) struct Met {
    pub(in crate::drawing) distance: f64,
    pub(in crate::drawing) position: DVec3,
    pub(in crate::drawing) normal: DVec3,
    pub(in crate::drawing) uv: DVec2,
    pub(in crate::drawing) origin: DVec3,
    pub(in crate::drawing) material: Option<u32>,
}

/// What came.
#[derive(Clone, Copy, Debug)]
pub(in crate::drawing) enum Got {
    /// Nothing that could be drawn: a panic, or no answer.
    NoAnswer,
    /// No hit.
    Miss,
    /// A hit.
    Hit(Met),
}

/// What of a hit the drawing is about: the first that is judged and not right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::drawing) enum Focus {
    /// Whether there is one, and how far away.
    Distance,
    /// Where it is, be that on the ray or not.
    Position,
    /// The normal there.
    Normal,
    /// The texture coordinates there.
    Uv,
    /// The origin that the answer names.
    Origin,
    /// The material that the answer names.
    Material,
}

/// One ray of a question, with both answers.
#[derive(Clone, Copy, Debug)]
pub(in crate::drawing) struct Encounter {
    pub(in crate::drawing) ray: Ray,
    pub(in crate::drawing) wanted: Option<Met>,
    pub(in crate::drawing) got: Got,
    pub(in crate::drawing) focus: Focus,
}

impl Encounter {
    /// The element of a question about rays; none of any other question, or if there is no such
    /// element, or if its ray is none.
    pub(in crate::drawing) fn of(
        asked: &Asked,
        element: usize,
        answer: Option<&Answer>,
    ) -> Option<Encounter> {
        let ray = *rays(&asked.question)?.get(element)?;
        let along = ray.dir.is_finite() && ray.dir.length() > 0.0;
        if !(ray.origin.is_finite() && along) {
            return None;
        }
        let (judged, wanted) = match &asked.key {
            Key::Hits { judged, hits } => {
                let hit = hits.get(element)?.as_ref();
                (judged.clone(), hit.map(|hit| Met::of_hit(hit, &ray)))
            }
            Key::FirstHits { hits, .. } => {
                let surface = hits.get(element)?.as_ref();
                let judged = vec![Part::Distance, Part::Normal, Part::Uv];
                (
                    judged,
                    surface.map(|surface| Met::of_surface(surface, &ray)),
                )
            }
            Key::Rays { .. } | Key::Spans { .. } | Key::Tree { .. } | Key::Radiance { .. } => {
                return None;
            }
        };
        let got = got(element, answer);
        let focus = focus(&judged, wanted.as_ref(), &got);
        Some(Encounter {
            ray,
            wanted,
            got,
            focus,
        })
    }

    /// Where the answer is drawn.
    pub(in crate::drawing) fn got_point(&self) -> Option<DVec3> {
        match (self.got, self.focus) {
            (Got::NoAnswer | Got::Miss, _) => None,
            (Got::Hit(met), Focus::Position) => Some(met.position),
            (
                Got::Hit(met),
                Focus::Distance | Focus::Normal | Focus::Uv | Focus::Origin | Focus::Material,
            ) => Some(self.at(met.distance)),
        }
    }

    /// The point of the ray at this distance.
    pub(in crate::drawing) fn at(&self, distance: f64) -> DVec3 {
        self.ray.origin.as_dvec3() + distance * self.dir()
    }

    /// The ray's direction, of length one.
    pub(in crate::drawing) fn dir(&self) -> DVec3 {
        self.ray.dir.as_dvec3().normalize()
    }

    /// The range, if it is not all that lies ahead.
    pub(in crate::drawing) fn range(&self) -> Option<Interval> {
        (self.ray.range != Interval::AHEAD).then_some(self.ray.range)
    }
}

fn rays(question: &Question) -> Option<Vec<Ray>> {
    match question {
        Question::Shapes { rays, .. }
        | Question::Traverse { rays, .. }
        | Question::BuildAndTraverse { rays, .. } => Some(rays.to_vec()),
        Question::Camera { .. }
        | Question::BBox { .. }
        | Question::Build { .. }
        | Question::Radiance { .. }
        | Question::Done => None,
    }
}

fn got(element: usize, answer: Option<&Answer>) -> Got {
    let outcome = match answer {
        Some(Answer::Hits(hits)) => hits.get(element),
        Some(
            Answer::Rays(_)
            | Answer::Spans(_)
            | Answer::Tree(_)
            | Answer::Picture(_)
            | Answer::Done,
        )
        | None => None,
    };
    match outcome {
        Some(Outcome::Value(Some(trace))) => Got::Hit(Met::of_trace(trace)),
        Some(Outcome::Value(None)) => Got::Miss,
        Some(Outcome::Panicked(_) | Outcome::GivenUp) | None => Got::NoAnswer,
    }
}

fn focus(judged: &[Part], wanted: Option<&Met>, got: &Got) -> Focus {
    let (Some(wanted), Got::Hit(got)) = (wanted, got) else {
        return Focus::Distance;
    };
    let is_wrong = |part: &&Part| match part {
        Part::Distance => is_far(got.distance, wanted.distance),
        Part::Position => is_apart(got.position, wanted.position),
        Part::Normal => is_apart(got.normal.normalize(), wanted.normal),
        Part::UnitNormal => is_far(got.normal.length(), 1.0),
        Part::Uv => is_apart(got.uv.extend(0.0), wanted.uv.extend(0.0)),
        Part::Origin => is_apart(got.origin, wanted.origin),
        Part::Material => got.material != wanted.material,
    };
    let part = judged.iter().find(is_wrong).or(judged.first());
    match part {
        Some(Part::Distance) | None => Focus::Distance,
        Some(Part::Position) => Focus::Position,
        Some(Part::Normal | Part::UnitNormal) => Focus::Normal,
        Some(Part::Uv) => Focus::Uv,
        Some(Part::Origin) => Focus::Origin,
        Some(Part::Material) => Focus::Material,
    }
}

/// Only to choose what is drawn: the judge has finer measures.
fn is_far(a: f64, b: f64) -> bool {
    let close = (a - b).abs() <= 1e-4 * b.abs().max(1.0);
    !close
}

fn is_apart(a: DVec3, b: DVec3) -> bool {
    is_far(a.distance(b), 0.0)
}

impl Met {
    fn of_hit(hit: &Hit, ray: &Ray) -> Met {
        Met {
            distance: hit.distance.into(),
            position: hit.position.as_dvec3(),
            normal: hit.normal.as_dvec3(),
            uv: hit.uv.as_dvec2(),
            origin: ray.origin.as_dvec3(),
            material: Some(hit.material),
        }
    }

    fn of_surface(surface: &Surface, ray: &Ray) -> Met {
        Met {
            distance: surface.depth.into(),
            position: ray.at(surface.depth).as_dvec3(),
            normal: surface.normal.as_dvec3(),
            uv: surface.uv.as_dvec2(),
            origin: ray.origin.as_dvec3(),
            material: None,
        }
    }

    fn of_trace(trace: &Trace) -> Met {
        Met {
            distance: trace.distance.into(),
            position: trace.position.as_dvec3(),
            normal: trace.normal.as_dvec3(),
            uv: trace.uv.as_dvec2(),
            origin: trace.origin.as_dvec3(),
            material: Some(trace.material),
        }
    }
}
