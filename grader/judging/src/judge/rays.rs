//! Rays from the camera.

use glam::Vec3;
use protocol::{Interval, Outcome, Ray};

use crate::describe;
use crate::exam::RayPart;
use crate::judge::deviation::of_outcome;
use crate::judge::measure::{
    DIRECTION, LENGTH, direction_error, length_error, point_error, unit_error,
};
use crate::judge::{
    Aspect, Blemish, Comparison, Deviation, How, Judgement, Measured, Share, Threshold, table,
    table_measured,
};

/// The camera's rays.
pub(super) struct CameraRays<'a> {
    pub(super) judged: &'a [RayPart],
    pub(super) directions: &'a [Vec3],
    pub(super) rays: &'a [Outcome<Ray>],
    /// A picture: partial credit by counting. Otherwise every ray must be right.
    pub(super) counted: bool,
}

impl Comparison for CameraRays<'_> {
    fn judge(&self) -> Judgement {
        let judgement = self.judge_table();
        if self.counted {
            by_count(judgement)
        } else {
            judgement
        }
    }

    fn measure(&self) -> Vec<Measured> {
        if !self.counted || self.rays.len() != self.directions.len() {
            return table_measured(self.rays, self.directions.len(), |element, ray| {
                self.deviations(element, ray)
            });
        }
        let allowed = Share::stragglers(self.rays.len());
        let count = Threshold::PicturePositions;
        vec![Measured::counted(self.worst(), allowed, count)]
    }

    fn blemishes(&self) -> Option<Vec<Option<Blemish>>> {
        let blemish = |(outcome, worst): (&Outcome<Ray>, Deviation)| match outcome {
            Outcome::Panicked(_) | Outcome::GivenUp => Some(Blemish::NO_ANSWER),
            Outcome::Value(_) => (!worst.is_right()).then_some(Blemish {
                aspect: Aspect::Direction,
                off: worst.value,
            }),
        };
        let is_picture = self.counted && self.rays.len() == self.directions.len();
        is_picture.then(|| self.rays.iter().zip(self.worst()).map(blemish).collect())
    }
}

impl CameraRays<'_> {
    fn judge_table(&self) -> Judgement {
        table(self.rays, self.directions.len(), |element, ray| {
            let wanted = self.directions[element];
            let mut judged = self.judged.iter();
            let part = judged.find(|part| !deviation(**part, ray, wanted).is_right())?;
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

    /// Of each ray, the part that is farthest off.
    fn worst(&self) -> Vec<Deviation> {
        let rays = self.rays.iter().enumerate();
        let worst = |(element, outcome)| {
            let parts = of_outcome(outcome, |ray| self.deviations(element, ray));
            let worst = parts.into_iter().max_by(|a, b| a.value.total_cmp(&b.value));
            worst.unwrap_or(Deviation::RIGHT)
        };
        rays.map(worst).collect()
    }

    fn deviations(&self, element: usize, ray: &Ray) -> Vec<Deviation> {
        let wanted = self.directions[element];
        let judged = self.judged.iter();
        judged.map(|part| deviation(*part, ray, wanted)).collect()
    }
}

/// The judgement of a picture, from that of a table.
fn by_count(mut judgement: Judgement) -> Judgement {
    if let Some((wrong, of)) = judgement.failure.as_ref().and_then(|failure| failure.count) {
        judgement.share = Share::by_count(wrong, of);
    }
    if judgement.share == Share::ALL {
        judgement.failure = None;
    }
    judgement
}

fn deviation(part: RayPart, ray: &Ray, wanted: Vec3) -> Deviation {
    match part {
        RayPart::Origin => Deviation::of(Threshold::Origin, point_error(ray.origin, Vec3::ZERO)),
        RayPart::Direction => {
            let error = direction_error(ray.dir, wanted, DIRECTION);
            Deviation::of(Threshold::Direction, error)
        }
        RayPart::UnitLength => Deviation::of(Threshold::UnitLength, unit_error(ray.dir)),
        RayPart::Range if ray.range.max != f32::INFINITY => Deviation::WRONG,
        RayPart::Range => {
            let error = length_error(ray.range.min, 0.0, LENGTH);
            Deviation::of(Threshold::Times, error)
        }
    }
}
