//! Clips the ray against six planes, each given by a normal and a point. This works for any convex
//! polyhedron. See Cyrus and Beck, "Generalized two- and three-dimensional clipping", Computers and
//! Graphics 3(1), 1978.

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
        for (outward, point) in self.planes() {
            let height = outward.dot(ray.origin - point);
            let climb = outward.dot(ray.dir);
            if climb > 0.0 {
                inside.max = inside.max.min(-height / climb);
            } else if climb < 0.0 {
                inside.min = inside.min.max(-height / climb);
            } else if height > 0.0 {
                return None;
            }
        }
        (!inside.is_empty()).then_some(inside)
    }

    /// Returns the outward normal of each face, and a point on the face.
    fn planes(&self) -> [(Vec3, Vec3); 6] {
        [
            (Vec3::NEG_X, self.min),
            (Vec3::NEG_Y, self.min),
            (Vec3::NEG_Z, self.min),
            (Vec3::X, self.max),
            (Vec3::Y, self.max),
            (Vec3::Z, self.max),
        ]
    }
}
