//! Checks whether rounding in single precision can change the answer to a `BBox::hit` call.

use glam::{DVec3, Vec3};

use super::call::BoxCall;
use crate::domains::fields::{EPSILON, FURTHEST_SIZES};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;

impl BoxCall {
    /// Returns whether all correct single-precision formulas agree on the outcome, i.e. whether it
    /// would be the same for a slightly larger or smaller box and slightly different times.
    pub fn is_clear(&self) -> bool {
        /// The margin, as a multiple of the box's size.
        const MARGIN: f64 = 0.02;
        /// The margin for a thin box, as a fraction of its side.
        const THIN_MARGIN: f64 = 0.1;
        let size = self.size();
        let sides = self.bounds.max - self.bounds.min;
        let margins = (THIN_MARGIN * sides).min(DVec3::splat(MARGIN * size));
        let (shorter, longer) = (self.duration_margin(), MARGIN * size);
        let is_flat = sides.cmpeq(DVec3::ZERO);
        let is_still = self.ray.dir.cmpeq(Vec3::ZERO);
        let origin = self.ray.origin.as_dvec3();
        let coordinates = origin
            .abs()
            .max(self.bounds.min.abs())
            .max(self.bounds.max.abs());
        let is_lost = |axis: usize| {
            let speed = f64::from(self.ray.dir[axis].abs());
            if is_flat.test(axis) && is_still.test(axis) {
                // Rays in the plane of a flat box aren't tested.
                (origin - self.bounds.min)[axis].abs() < longer
            } else if is_flat.test(axis) {
                // The point where a slanted ray crosses the plane depends on how the time is
                // rounded.
                let late = 8.0 * EPSILON * coordinates.max_element() / speed;
                let is_far = |other: usize| {
                    let away = late * f64::from(self.ray.dir[other].abs());
                    !is_flat.test(other) && away > 0.25 * margins[other]
                };
                let time = (self.bounds.min - origin)[axis] / f64::from(self.ray.dir[axis]);
                let ends = [self.times.min, self.times.max].map(f64::from);
                let is_at_an_end = ends.iter().any(|end| (end - time).abs() < late);
                is_at_an_end || late > 0.25 * longer || (0..3).any(is_far)
            } else {
                // Rays in the plane of a face aren't tested either.
                let sides = [self.bounds.min, self.bounds.max];
                let is_in_plane = sides.iter().any(|side| side[axis] == origin[axis]);
                is_still.test(axis) && is_in_plane
                    || margins[axis] < 8.0 * EPSILON * coordinates.max_element()
            }
        };
        let distance = (origin - self.bounds.center()).abs().max_element();
        if distance > FURTHEST_SIZES * size
            || (0..3).any(is_lost)
            || self.is_decided_by_rounding(coordinates.max_element())
        {
            return false;
        }
        let hits_with = |sign: f64, margin: f64| {
            let bounds = Bounds {
                min: self.bounds.min - sign * margins,
                max: self.bounds.max + sign * margins,
            };
            let ray64 = self.ray64();
            let ray64 = Ray64 {
                min: ray64.min - sign * margin,
                max: ray64.max + sign * margin,
                ..ray64
            };
            bounds.span(&ray64).is_some()
        };
        hits_with(1.0, longer) == hits_with(-1.0, shorter)
    }

    /// Returns whether the ray enters or leaves the box through a side that it is almost parallel
    /// to, so that rounding changes the time.
    fn is_decided_by_rounding(&self, coordinates: f64) -> bool {
        /// The largest fraction of a tolerance that errors may use up.
        const PART: f64 = 0.3;
        let ray64 = self.ray64();
        let Some((enter, leave)) = self.bounds.span(&ray64) else {
            return false;
        };
        (0..3).any(|axis| {
            let speed = ray64.dir[axis];
            let sides = [self.bounds.min, self.bounds.max];
            let times = sides.map(|side| (side - ray64.origin)[axis] / speed);
            let error = 4.0 * EPSILON * coordinates / speed.abs();
            let decides = |end: f64| times.iter().any(|time| (time - end).abs() <= 4.0 * error);
            speed != 0.0 && error > PART * 1e-4 * coordinates && (decides(enter) || decides(leave))
        })
    }

    /// Returns the amount by which the times can be shortened at each end.
    fn duration_margin(&self) -> f64 {
        let ray64 = self.ray64();
        (0.02 * self.size()).min(0.25 * (ray64.max - ray64.min))
    }
}
