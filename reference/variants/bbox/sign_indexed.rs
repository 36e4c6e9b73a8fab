//! Picks the plane to enter by, along each axis, by the sign of the inverse direction: of the
//! inverse, since −0 compares as 0 but its inverse is −∞. Williams, Barrus, Morley and Shirley,
//! "An Efficient and Robust Ray-Box Intersection Algorithm", Journal of Graphics Tools 10(1),
//! 2005.

use glam::Vec3;
use protocol::{Interval, Ray};

/// An axis-parallel box; empty if `min` exceeds `max` along any axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BBox {
    /// The smallest corner.
    pub min: Vec3,
    /// The largest corner.
    pub max: Vec3,
}

impl BBox {
    /// A box around nothing.
    pub const EMPTY: BBox = BBox {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The box between two corners.
    pub fn new(min: Vec3, max: Vec3) -> Self {
        BBox { min, max }
    }

    /// Grows the box until it holds `other` as well.
    pub fn enclose(&mut self, other: BBox) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// Grows the box until it holds `point` as well.
    pub fn enclose_point(&mut self, point: Vec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    /// The middle of the box.
    pub fn center(&self) -> Vec3 {
        0.5 * (self.min + self.max)
    }

    /// The area of its six faces; zero for an empty box.
    pub fn surface_area(&self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let size = self.max - self.min;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Whether there is no point in the box. A flat box is not empty.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// The part of `times` during which the ray is inside the box, or `None`.
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
