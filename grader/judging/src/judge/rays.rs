//! Compares camera rays with the key.

use glam::Vec3;
use protocol::{ElementOutcome, Interval, Ray};

use crate::exam::RayCheck;
use crate::judge::deviation::outcome_deviations;
use crate::judge::quantity::Quantity;
use crate::judge::{
    Aspect, Comparison, Credit, Deviation, FailureKind, Judgement, Measurement, Mismatch, Table,
    Threshold,
};

/// The scale of camera rays: the length of their directions.
const SCALE: f32 = 1.0;

/// Camera rays and their key. Every ray must be correct.
pub(super) struct CameraRays<'a> {
    pub(super) checks: &'a [RayCheck],
    pub(super) directions: &'a [Vec3],
    pub(super) rays: &'a [ElementOutcome<Ray>],
}

/// The rays of a whole picture, which earns partial credit by the number of wrong rays.
pub(super) struct RayPicture<'a>(pub(super) CameraRays<'a>);

impl Table for CameraRays<'_> {
    type Value = Ray;

    fn outcomes(&self) -> &[ElementOutcome<Ray>] {
        self.rays
    }

    fn count(&self) -> usize {
        self.directions.len()
    }

    fn deviations(&self, element: usize, got: &Ray) -> Vec<Deviation> {
        let wanted = self.wanted(element);
        let deviation = |check: &RayCheck| {
            let quantity = |ray| Quantity::of_ray(*check, ray);
            quantity(got).deviation(quantity(&wanted), SCALE)
        };
        self.checks.iter().map(deviation).collect()
    }

    fn failure(&self, element: usize, got: &Ray, check: usize) -> FailureKind {
        let quantity = |ray| Quantity::of_ray(self.checks[check], ray);
        quantity(got).failure(quantity(&self.wanted(element)))
    }
}

impl CameraRays<'_> {
    fn wanted(&self, element: usize) -> Ray {
        expected_ray(self.directions[element])
    }
}

/// Returns the camera ray with this direction.
pub(crate) fn expected_ray(dir: Vec3) -> Ray {
    Ray {
        origin: Vec3::ZERO,
        dir,
        range: Interval::AHEAD,
    }
}

impl Comparison for RayPicture<'_> {
    fn judge(&self) -> Judgement {
        with_partial_credit(self.0.judge())
    }

    fn measure(&self) -> Vec<Measurement> {
        let Some(worst) = self.worst_deviations() else {
            return self.0.measure();
        };
        let allowed = Credit::tolerated(worst.len());
        let count = Threshold::PicturePositions;
        vec![Measurement::of_positions(worst, allowed, count)]
    }

    fn mismatches(&self) -> Option<Vec<Option<Mismatch>>> {
        let mismatch = |(outcome, worst): (&ElementOutcome<Ray>, Deviation)| match outcome {
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => Some(Mismatch::NO_ANSWER),
            ElementOutcome::Value(_) => (!worst.is_right()).then_some(Mismatch {
                aspect: Aspect::Direction,
                deviation: worst.value,
            }),
        };
        let outcomes = self.0.rays.iter().zip(self.worst_deviations()?);
        Some(outcomes.map(mismatch).collect())
    }
}

impl RayPicture<'_> {
    /// Returns the largest deviation of each ray, or `None` if the number of rays is wrong.
    fn worst_deviations(&self) -> Option<Vec<Deviation>> {
        let rays = self.0.rays.iter().enumerate();
        let worst = |(element, outcome)| {
            let parts = outcome_deviations(outcome, |ray| self.0.deviations(element, ray));
            let worst = parts.into_iter().max_by(|a, b| a.value.total_cmp(&b.value));
            worst.unwrap_or(Deviation::RIGHT)
        };
        (self.0.rays.len() == self.0.count()).then(|| rays.map(worst).collect())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::measure::{DIRECTION, LENGTH};

    /// A ray with an error in its origin, its direction and its range, of these multiples of their
    /// tolerances.
    fn ray(origin: f32, direction: f32, range: f32) -> ElementOutcome<Ray> {
        ElementOutcome::Value(Ray {
            origin: Vec3::X * (origin * LENGTH * SCALE),
            dir: Vec3::NEG_Z + Vec3::X * (direction * DIRECTION),
            range: Interval::new(range * LENGTH, f32::INFINITY),
        })
    }

    fn compare(rays: &[ElementOutcome<Ray>]) -> CameraRays<'_> {
        CameraRays {
            checks: &[RayCheck::Origin, RayCheck::Direction, RayCheck::Range],
            directions: &[Vec3::NEG_Z],
            rays,
        }
    }

    #[test]
    fn the_first_check_that_fails_is_named() {
        let what = |ray| match compare(&[ray]).judge().failure.unwrap().kind {
            FailureKind::Wrong { what, .. } => what,
            other @ (FailureKind::Panicked(_) | FailureKind::Protocol(_)) => panic!("{other:?}"),
        };
        assert_eq!(what(ray(2.0, 9.0, 9.0)), "origin");
        assert_eq!(what(ray(0.5, 2.0, 9.0)), "direction");
        assert_eq!(what(ray(0.5, 0.5, 2.0)), "range");
        assert_eq!(compare(&[ray(0.5, 0.5, 0.5)]).judge().failure, None);
    }

    #[test]
    fn the_largest_error_of_a_pixel_counts() {
        for ray in [ray(3.0, 7.0, 2.0), ray(7.0, 3.0, 2.0), ray(2.0, 3.0, 7.0)] {
            let mismatches = RayPicture(compare(&[ray])).mismatches().unwrap();
            let deviation = mismatches[0].unwrap().deviation;
            assert!((deviation - 7.0).abs() < 0.01, "{deviation}");
        }
    }
}
