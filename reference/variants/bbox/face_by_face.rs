//! Meets the six faces, each a rectangle: the times at which the ray is on the box, and the ends
//! of `times` where they lie in it, are all there is to choose from.

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

    /// When the ray meets the two faces across `axis`.
    fn on_faces(&self, ray: &Ray, axis: usize) -> [Option<f32>; 2] {
        [self.min, self.max].map(|corner| {
            let time = (corner[axis] - ray.origin[axis]) / ray.dir[axis];
            let mut point = ray.at(time);
            // On the plane for sure, whatever the rounding.
            point[axis] = corner[axis];
            self.around(point).then_some(time)
        })
    }

    fn holds(&self, ray: &Ray, time: f32) -> bool {
        // An endless ray ends outside every box, even where 0 · ∞ cannot tell.
        time.is_finite() && self.around(ray.at(time))
    }

    fn around(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }
}
