//! Compares camera rays with the key.

use glam::Vec3;
use protocol::{ElementOutcome, Interval, Ray};

use crate::describe;
use crate::exam::RayCheck;
use crate::judge::deviation::outcome_deviations;
use crate::judge::measure::{
    DIRECTION, LENGTH, direction_error, length_error, point_error, unit_error,
};
use crate::judge::{
    Aspect, Comparison, Credit, Deviation, FailureKind, Judgement, Measurement, Mismatch,
    Threshold, judge_table, measure_table,
};

/// The scale of camera rays: the length of their directions.
const SCALE: f32 = 1.0;

/// Camera rays and their key.
pub(super) struct CameraRays<'a> {
    pub(super) checks: &'a [RayCheck],
    pub(super) directions: &'a [Vec3],
    pub(super) rays: &'a [ElementOutcome<Ray>],
    /// Whether the rays are those of a whole picture, which earns partial credit by the number of
    /// wrong rays. Otherwise, every ray must be correct.
    pub(super) is_picture: bool,
}

impl Comparison for CameraRays<'_> {
    fn judge(&self) -> Judgement {
        let judgement = self.judge_table();
        if self.is_picture {
            with_partial_credit(judgement)
        } else {
            judgement
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        if !self.is_picture || self.rays.len() != self.directions.len() {
            return measure_table(self.rays, self.directions.len(), |element, ray| {
                self.deviations(element, ray)
            });
        }
        let allowed = Credit::tolerated(self.rays.len());
        let count = Threshold::PicturePositions;
        vec![Measurement::of_positions(
            self.worst_deviations(),
            allowed,
            count,
        )]
    }

    fn mismatches(&self) -> Option<Vec<Option<Mismatch>>> {
        let mismatch = |(outcome, worst): (&ElementOutcome<Ray>, Deviation)| match outcome {
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => Some(Mismatch::NO_ANSWER),
            ElementOutcome::Value(_) => (!worst.is_right()).then_some(Mismatch {
                aspect: Aspect::Direction,
                deviation: worst.value,
            }),
        };
        let is_picture = self.is_picture && self.rays.len() == self.directions.len();
        is_picture.then(|| {
            self.rays
                .iter()
                .zip(self.worst_deviations())
                .map(mismatch)
                .collect()
        })
    }
}

impl CameraRays<'_> {
    fn judge_table(&self) -> Judgement {
        judge_table(self.rays, self.directions.len(), |element, ray| {
            let wanted = self.directions[element];
            let mut checks = self.checks.iter();
            let part = checks.find(|part| !deviation(**part, ray, wanted).is_right())?;
            Some(match part {
                RayCheck::Origin => FailureKind::Wrong {
                    what: "origin".to_owned(),
                    got: describe::point(ray.origin),
                    wanted: describe::point(Vec3::ZERO),
                },
                RayCheck::Direction => FailureKind::Wrong {
                    what: "direction".to_owned(),
                    got: describe::point(ray.dir),
                    wanted: describe::point(wanted),
                },
                RayCheck::UnitLength => FailureKind::Wrong {
                    what: "length of the direction".to_owned(),
                    got: describe::number(ray.dir.length()),
                    wanted: describe::number(1.0),
                },
                RayCheck::Range => FailureKind::Wrong {
                    what: "range".to_owned(),
                    got: describe::interval(ray.range),
                    wanted: describe::interval(Interval::AHEAD),
                },
            })
        })
    }

    /// Returns the largest deviation of each ray.
    fn worst_deviations(&self) -> Vec<Deviation> {
        let rays = self.rays.iter().enumerate();
        let worst = |(element, outcome)| {
            let parts = outcome_deviations(outcome, |ray| self.deviations(element, ray));
            let worst = parts.into_iter().max_by(|a, b| a.value.total_cmp(&b.value));
            worst.unwrap_or(Deviation::RIGHT)
        };
        rays.map(worst).collect()
    }

    fn deviations(&self, element: usize, ray: &Ray) -> Vec<Deviation> {
        let wanted = self.directions[element];
        let checks = self.checks.iter();
        checks.map(|part| deviation(*part, ray, wanted)).collect()
    }
}

/// Converts the judgement of a list of rays to that of a picture, which can earn partial credit.
fn with_partial_credit(mut judgement: Judgement) -> Judgement {
    if let Some((wrong, of)) = judgement.failure.as_ref().and_then(|failure| failure.count) {
        judgement.credit = Credit::by_count(wrong, of);
    }
    if judgement.credit == Credit::FULL {
        judgement.failure = None;
    }
    judgement
}

fn deviation(part: RayCheck, ray: &Ray, wanted: Vec3) -> Deviation {
    match part {
        RayCheck::Origin => Deviation::new(
            Threshold::Origin,
            point_error(ray.origin, Vec3::ZERO, SCALE),
        ),
        RayCheck::Direction => {
            let error = direction_error(ray.dir, wanted, DIRECTION);
            Deviation::new(Threshold::Direction, error)
        }
        RayCheck::UnitLength => Deviation::new(Threshold::UnitLength, unit_error(ray.dir)),
        RayCheck::Range if ray.range.max != f32::INFINITY => Deviation::WRONG,
        RayCheck::Range => {
            let error = length_error(ray.range.min, 0.0, SCALE, LENGTH);
            Deviation::new(Threshold::Times, error)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ray with an error in its origin, its direction and its range, of these multiples of their
    /// tolerances.
    fn ray(origin: f32, direction: f32, range: f32) -> ElementOutcome<Ray> {
        ElementOutcome::Value(Ray {
            origin: Vec3::X * (origin * LENGTH * SCALE),
            dir: Vec3::NEG_Z + Vec3::X * (direction * DIRECTION),
            range: Interval::new(range * LENGTH, f32::INFINITY),
        })
    }

    fn compare(rays: &[ElementOutcome<Ray>], is_picture: bool) -> CameraRays<'_> {
        CameraRays {
            checks: &[RayCheck::Origin, RayCheck::Direction, RayCheck::Range],
            directions: &[Vec3::NEG_Z],
            rays,
            is_picture,
        }
    }

    #[test]
    fn the_first_check_that_fails_is_named() {
        let what = |ray| match compare(&[ray], false).judge().failure.unwrap().kind {
            FailureKind::Wrong { what, .. } => what,
            other @ (FailureKind::Panicked(_) | FailureKind::Protocol(_)) => panic!("{other:?}"),
        };
        assert_eq!(what(ray(2.0, 9.0, 9.0)), "origin");
        assert_eq!(what(ray(0.5, 2.0, 9.0)), "direction");
        assert_eq!(what(ray(0.5, 0.5, 2.0)), "range");
        assert_eq!(compare(&[ray(0.5, 0.5, 0.5)], false).judge().failure, None);
    }

    #[test]
    fn the_largest_error_of_a_pixel_counts() {
        for ray in [ray(3.0, 7.0, 2.0), ray(7.0, 3.0, 2.0), ray(2.0, 3.0, 7.0)] {
            let mismatches = compare(&[ray], true).mismatches().unwrap();
            let deviation = mismatches[0].unwrap().deviation;
            assert!((deviation - 7.0).abs() < 0.01, "{deviation}");
        }
    }
}
