//! A fold over the axes, by one multiplication and one addition for each plane: (plane − origin) ·
//! inverse = plane · inverse − origin · inverse; in double precision, where the two products do
//! not eat each other's digits.

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
        let inverse = ray.dir.as_dvec3().recip();
        let shift = -ray.origin.as_dvec3() * inverse;
        (0..3).try_fold(times, |inside, axis| {
            if ray.dir[axis] == 0.0 {
                // ∞ − ∞ says nothing.
                let slab = self.min[axis]..=self.max[axis];
                return slab.contains(&ray.origin[axis]).then_some(inside);
            }
            let time = |plane: f32| (f64::from(plane) * inverse[axis] + shift[axis]) as f32;
            let (a, b) = (time(self.min[axis]), time(self.max[axis]));
            let inside = Interval::new(inside.min.max(a.min(b)), inside.max.min(a.max(b)));
            (inside.min <= inside.max).then_some(inside)
        })
    }
}
