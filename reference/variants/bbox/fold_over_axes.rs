//! Folds over the axes, with one multiplication and one addition per plane: (plane − origin) ·
//! inverse = plane · inverse − origin · inverse. The products are in double precision, to avoid
//! cancellation.

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
        let inverse = ray.dir.as_dvec3().recip();
        let shift = -ray.origin.as_dvec3() * inverse;
        (0..3).try_fold(times, |inside, axis| {
            if ray.dir[axis] == 0.0 {
                // If the ray is parallel to the slab, the formula would be ∞ − ∞.
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
