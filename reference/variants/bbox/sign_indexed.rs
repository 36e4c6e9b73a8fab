//! Selects the plane through which the ray enters each slab by the sign of the inverse direction.
//! The sign of the direction itself would not be enough: −0 is not less than 0, but its inverse is
//! −∞. See Williams, Barrus, Morley and Shirley, "An Efficient and Robust Ray-Box Intersection
//! Algorithm", Journal of Graphics Tools 10(1), 2005.

use glam::Vec3;
use protocol::{Interval, Ray};

/// An axis-aligned bounding box. It is empty if `min` is greater than `max` along any axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BBox {
    /// The corner with the smallest coordinates.
    pub min: Vec3,
    /// The corner with the largest coordinates.
    pub max: Vec3,
}

impl BBox {
    /// The empty box. After it encloses something, it is the box of exactly that.
    pub const EMPTY: BBox = BBox {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// Creates the box between two corners.
    pub fn new(min: Vec3, max: Vec3) -> Self {
        BBox { min, max }
    }

    /// Grows the box to contain `other` as well.
    pub fn enclose(&mut self, other: BBox) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// Grows the box to contain `point` as well.
    pub fn enclose_point(&mut self, point: Vec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    /// Returns the centre of the box.
    pub fn center(&self) -> Vec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the total area of the six faces, or zero for an empty box.
    pub fn surface_area(&self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let size = self.max - self.min;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Returns whether the box contains no point. A flat box is not empty.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Returns the part of `times` during which the ray is inside the box, or `None` if there is
    /// none.
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let bounds = [self.min, self.max];
        let inverse = ray.dir.recip();
        let sign = inverse
            .to_array()
            .map(|component| usize::from(component < 0.0));
        let enter = |axis: usize| (bounds[sign[axis]][axis] - ray.origin[axis]) * inverse[axis];
        let leave = |axis: usize| (bounds[1 - sign[axis]][axis] - ray.origin[axis]) * inverse[axis];

        let (mut min, mut max) = (enter(0), leave(0));
        for axis in 1..3 {
            let (next_min, next_max) = (enter(axis), leave(axis));
            if min > next_max || next_min > max {
                return None;
            }
            min = min.max(next_min);
            max = max.min(next_max);
        }
        if min > times.max || max < times.min {
            return None;
        }
        Some(Interval::new(min.max(times.min), max.min(times.max)))
    }
}
