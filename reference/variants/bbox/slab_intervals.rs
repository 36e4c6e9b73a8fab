//! Each slab is an interval of times, and the box is what they share with `times`: small
//! functions, and `?` as the way out.

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
        let inside = overlap(times, self.slab(ray, 0))?;
        let inside = overlap(inside, self.slab(ray, 1))?;
        overlap(inside, self.slab(ray, 2))
    }

    /// When the ray is between the two planes across `axis`.
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
