//! Tables of hits.

use protocol::{Outcome, Ray, Trace};

use crate::describe;
use crate::exam::{Hit, Part};
use crate::judge::measure::{
    DIRECTION, LENGTH, is_unit, same_direction, same_length, same_point, same_uv,
};
use crate::judge::{How, Judgement, table};

pub(super) fn judge(
    judged: &[Part],
    rays: &[Ray],
    hits: &[Option<Hit>],
    answers: &[Outcome<Option<Trace>>],
) -> Judgement {
    table(answers, hits.len(), |element, got| {
        match (got, &hits[element]) {
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
            (Some(trace), Some(hit)) => judged
                .iter()
                .find_map(|part| wrong_part(*part, &rays[element], trace, hit)),
        }
    })
}

/// What is wrong with one part of a hit, if anything is.
fn wrong_part(part: Part, ray: &Ray, trace: &Trace, hit: &Hit) -> Option<How> {
    let (what, right, got, wanted) = match part {
        Part::Distance => (
            "distance",
            same_length(trace.distance, hit.distance, LENGTH),
            describe::number(trace.distance),
            describe::number(hit.distance),
        ),
        Part::Position => (
            "position",
            same_point(trace.position, hit.position),
            describe::point(trace.position),
            describe::point(hit.position),
        ),
        Part::Normal => (
            "normal",
            same_direction(trace.normal, hit.normal, DIRECTION),
            describe::point(trace.normal),
            describe::point(hit.normal),
        ),
        Part::UnitNormal => (
            "length of the normal",
            is_unit(trace.normal),
            describe::number(trace.normal.length()),
            describe::number(1.0),
        ),
        Part::Uv => (
            "uv",
            same_uv(trace.uv, hit.uv),
            describe::uv(trace.uv),
            describe::uv(hit.uv),
        ),
        Part::Origin => (
            "origin",
            same_point(trace.origin, ray.origin),
            describe::point(trace.origin),
            describe::point(ray.origin),
        ),
        Part::Material => (
            "material",
            trace.material == hit.material,
            trace.material.to_string(),
            hit.material.to_string(),
        ),
    };
    (!right).then(|| How::Wrong {
        what: what.to_owned(),
        got,
        wanted,
    })
}
