//! Computes an interval of times for each slab, and intersects `times` with these intervals,
//! returning early with `?` if nothing is left.

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
        let inside = overlap(times, self.slab(ray, 0))?;
        let inside = overlap(inside, self.slab(ray, 1))?;
        overlap(inside, self.slab(ray, 2))
    }

    /// Returns the times during which the ray is between the two planes perpendicular to `axis`.
    fn slab(&self, ray: &Ray, axis: usize) -> Interval {
        let time = |plane: f32| (plane - ray.origin[axis]) / ray.dir[axis];
        let (a, b) = (time(self.min[axis]), time(self.max[axis]));
        if a < b {
            Interval::new(a, b)
        } else {
            Interval::new(b, a)
        }
    }
}

fn overlap(a: Interval, b: Interval) -> Option<Interval> {
    let both = Interval::new(a.min.max(b.min), a.max.min(b.max));
    (!both.is_empty()).then_some(both)
}
