//! Intersects the six faces, each a rectangle. The result is the interval from the earliest to the
//! latest of these hits and of those ends of `times` at which the ray is inside the box.

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
        let mut inside = Interval::new(f32::INFINITY, f32::NEG_INFINITY);
        let on_faces = (0..3).flat_map(|axis| self.on_faces(ray, axis));
        let on_faces = on_faces.flatten().filter(|time| times.contains(*time));
        let ends = [times.min, times.max];
        let ends = ends.into_iter().filter(|time| self.holds(ray, *time));
        for time in on_faces.chain(ends) {
            inside.min = inside.min.min(time);
            inside.max = inside.max.max(time);
        }
        (!inside.is_empty()).then_some(inside)
    }

    /// Returns the times at which the ray hits the two faces perpendicular to `axis`.
    fn on_faces(&self, ray: &Ray, axis: usize) -> [Option<f32>; 2] {
        [self.min, self.max].map(|corner| {
            let time = (corner[axis] - ray.origin[axis]) / ray.dir[axis];
            let mut point = ray.at(time);
            // Rounding may have moved the point off the plane.
            point[axis] = corner[axis];
            self.around(point).then_some(time)
        })
    }

    fn holds(&self, ray: &Ray, time: f32) -> bool {
        // At an infinite time the ray is outside every box; 0 · ∞ would give NaN.
        time.is_finite() && self.around(ray.at(time))
    }

    fn around(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }
}
