//! The slabs in double precision, rounded once at the end.

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
        let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        let to_min = (self.min.as_dvec3() - origin) / dir;
        let to_max = (self.max.as_dvec3() - origin) / dir;
        let enter = to_min.min(to_max).max_element().max(f64::from(times.min));
        let leave = to_min.max(to_max).min_element().min(f64::from(times.max));
        (enter <= leave).then_some(Interval::new(enter as f32, leave as f32))
    }
}
