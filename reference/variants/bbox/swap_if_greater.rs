//! Axis by axis, with a swap if the two times come in the wrong order, and out at the first axis
//! that leaves nothing: Shirley, Black and Hollasch, "Ray Tracing: The Next Week", "Ray
//! Intersection with an AABB".

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
        let mut inside = times;
        for axis in 0..3 {
            let inverse = 1.0 / ray.dir[axis];
            let mut enter = (self.min[axis] - ray.origin[axis]) * inverse;
            let mut leave = (self.max[axis] - ray.origin[axis]) * inverse;
            if enter > leave {
                std::mem::swap(&mut enter, &mut leave);
            }

            inside.min = inside.min.max(enter);
            inside.max = inside.max.min(leave);
            if inside.min > inside.max {
                return None;
            }
        }
        Some(inside)
    }
}
