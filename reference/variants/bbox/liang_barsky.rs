//! Six inequalities p·t ≤ q, each of which moves one end of the interval: Liang and Barsky, "A New
//! Concept and Method for Line Clipping", ACM Transactions on Graphics 3(1), 1984.

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
        let Interval { mut min, mut max } = times;
        let to_min = ray.origin - self.min;
        let to_max = self.max - ray.origin;
        let inequalities = (0..3).flat_map(|axis| {
            [
                (-ray.dir[axis], to_min[axis]),
                (ray.dir[axis], to_max[axis]),
            ]
        });
        for (p, q) in inequalities {
            if p == 0.0 {
                if q < 0.0 {
                    return None;
                }
            } else if p < 0.0 {
                // The ray comes in here.
                min = min.max(q / p);
            } else {
                max = max.min(q / p);
            }
            if min > max {
                return None;
            }
        }
        Some(Interval::new(min, max))
    }
}
