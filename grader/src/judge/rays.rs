//! Rays from the camera.

use glam::Vec3;
use protocol::{Interval, Outcome, Ray};

use crate::describe;
use crate::exam::RayPart;
use crate::judge::measure::{DIRECTION, LENGTH, is_unit, same_direction, same_length};
use crate::judge::{How, Judgement, Share, table};

/// A table: every ray must be right.
pub(super) fn table_of(
    judged: &[RayPart],
    directions: &[Vec3],
    rays: &[Outcome<Ray>],
) -> Judgement {
    table(rays, directions.len(), |element, ray| {
        let wanted = directions[element];
        let part = judged.iter().find(|part| !is_right(**part, ray, wanted))?;
        Some(match part {
            RayPart::Origin => How::Wrong {
                what: "origin".to_owned(),
                got: describe::point(ray.origin),
                wanted: describe::point(Vec3::ZERO),
            },
            RayPart::Direction => How::Wrong {
                what: "direction".to_owned(),
                got: describe::point(ray.dir),
                wanted: describe::point(wanted),
            },
            RayPart::UnitLength => How::Wrong {
                what: "length of the direction".to_owned(),
                got: describe::number(ray.dir.length()),
                wanted: describe::number(1.0),
            },
            RayPart::Range => How::Wrong {
                what: "range".to_owned(),
                got: describe::interval(ray.range),
                wanted: describe::interval(Interval::AHEAD),
            },
        })
    })
}

/// A picture: partial credit by counting.
pub(super) fn picture(judged: &[RayPart], directions: &[Vec3], rays: &[Outcome<Ray>]) -> Judgement {
    let mut judgement = table_of(judged, directions, rays);
    if let Some((wrong, of)) = judgement.failure.as_ref().and_then(|failure| failure.count) {
        judgement.share = Share::by_count(wrong, of);
    }
    if judgement.share == Share::ALL {
        judgement.failure = None;
    }
    judgement
}

fn is_right(part: RayPart, ray: &Ray, wanted: Vec3) -> bool {
    match part {
        RayPart::Origin => ray.origin.length() <= LENGTH,
        RayPart::Direction => same_direction(ray.dir, wanted, DIRECTION),
        RayPart::UnitLength => is_unit(ray.dir),
        RayPart::Range => same_length(ray.range.min, 0.0, LENGTH) && ray.range.max == f32::INFINITY,
    }
}
