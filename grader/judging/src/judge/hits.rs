//! Tables of hits.

use protocol::{Outcome, Ray, Trace};

use crate::describe;
use crate::exam::{Hit, Part};
use crate::judge::measure::{
    DIRECTION, LENGTH, direction_error, length_error, point_error, unit_error, uv_error,
};
use crate::judge::{
    Comparison, Deviation, How, Judgement, Measured, Threshold, table, table_measured,
};

/// Hits, of which every one must be right.
pub(super) struct Hits<'a> {
    pub(super) judged: &'a [Part],
    pub(super) rays: Vec<Ray>,
    pub(super) hits: &'a [Option<Hit>],
    pub(super) answers: &'a [Outcome<Option<Trace>>],
}

impl Comparison for Hits<'_> {
    fn judge(&self) -> Judgement {
        table(self.answers, self.hits.len(), |element, got| {
            match (got, &self.hits[element]) {
                (None, None) => None,
                (Some(trace), None) => Some(How::Wrong {
                    what: "hit or miss".to_owned(),
                    got: describe::hit_at(trace.distance),
                    wanted: "no hit".to_owned(),
                }),
                (None, Some(hit)) => Some(How::Wrong {
                    what: "hit or miss".to_owned(),
                    got: "no hit".to_owned(),
                    wanted: describe::hit_at(hit.distance),
                }),
                (Some(trace), Some(hit)) => {
                    let ray = &self.rays[element];
                    let mut judged = self.judged.iter();
                    judged.find_map(|part| wrong_part(*part, ray, trace, hit))
                }
            }
        })
    }

    fn measure(&self) -> Vec<Measured> {
        table_measured(self.answers, self.hits.len(), |element, got| {
            match (got, &self.hits[element]) {
                (None, None) => Vec::new(),
                (Some(_), None) | (None, Some(_)) => vec![Deviation::WRONG],
                (Some(trace), Some(hit)) => {
                    let ray = &self.rays[element];
                    let judged = self.judged.iter();
                    judged
                        .map(|part| deviation(*part, ray, trace, hit))
                        .collect()
                }
            }
        })
    }
}

/// How far off one part of a hit is.
fn deviation(part: Part, ray: &Ray, trace: &Trace, hit: &Hit) -> Deviation {
    let (threshold, error) = match part {
        Part::Distance => (
            Threshold::Distance,
            length_error(trace.distance, hit.distance, LENGTH),
        ),
        Part::Position => (
            Threshold::Position,
            point_error(trace.position, hit.position),
        ),
        Part::Normal => (
            Threshold::Normal,
            direction_error(trace.normal, hit.normal, DIRECTION),
        ),
        Part::UnitNormal => (Threshold::UnitLength, unit_error(trace.normal)),
        Part::Uv => (Threshold::Uv, uv_error(trace.uv, hit.uv)),
        Part::Origin => (Threshold::Origin, point_error(trace.origin, ray.origin)),
        Part::Material => return Deviation::unless(trace.material == hit.material),
    };
    Deviation::of(threshold, error)
}

/// What is wrong with one part of a hit, if anything is.
fn wrong_part(part: Part, ray: &Ray, trace: &Trace, hit: &Hit) -> Option<How> {
    if deviation(part, ray, trace, hit).is_right() {
        return None;
    }
    let (what, got, wanted) = match part {
        Part::Distance => (
            "distance",
            describe::number(trace.distance),
            describe::number(hit.distance),
        ),
        Part::Position => (
            "position",
            describe::point(trace.position),
            describe::point(hit.position),
        ),
        Part::Normal => (
            "normal",
            describe::point(trace.normal),
            describe::point(hit.normal),
        ),
        Part::UnitNormal => (
            "length of the normal",
            describe::number(trace.normal.length()),
            describe::number(1.0),
        ),
        Part::Uv => ("uv", describe::uv(trace.uv), describe::uv(hit.uv)),
        Part::Origin => (
            "origin",
            describe::point(trace.origin),
            describe::point(ray.origin),
        ),
        Part::Material => (
            "material",
            trace.material.to_string(),
            hit.material.to_string(),
        ),
    };
    Some(How::Wrong {
        what: what.to_owned(),
        got,
        wanted,
    })
}
