//! Goes through the axes one by one, swaps the two times if they are in the wrong order, and
//! returns at the first axis that leaves an empty interval. See Shirley, Black and Hollasch, "Ray
//! Tracing: The Next Week", "Ray Intersection with an AABB".

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
