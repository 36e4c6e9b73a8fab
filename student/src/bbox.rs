//! Task 3, step 0: rays against boxes. Handout: "Boxes".
//!
//! ```text
//!                    │ x slab  │
//!         ───────────┌─────────┐─── max
//!           y slab   │    ╱    │
//!         ───────────└───╱─────┘───
//!                min │  ╱      │       inside the box: inside all three slabs at once
//!                      o
//! ```

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
    ///
    /// - Only `times` counts here, not `ray.range`. What is returned is clipped to it: a ray that
    ///   starts inside the box is inside from `times.min` on, and if all of `times` is inside, all
    ///   of it comes back.
    /// - A component of `ray.dir` may be 0 or −0: such a ray stays in one slab, or outside it.
    /// - The box may be flat (`min == max` along an axis) and still be hit.
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        todo!("task 3, bbox: when, within {times:?}, is {ray:?} inside {self:?}?")
    }
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;

    fn cube() -> BBox {
        BBox::new(Vec3::NEG_ONE, Vec3::ONE)
    }

    #[track_caller]
    fn assert_inside(got: Option<Interval>, min: f32, max: f32) {
        let close = |got: Interval| (got.min - min).abs() < 1e-5 && (got.max - max).abs() < 1e-5;
        assert!(
            got.is_some_and(close),
            "got {got:?}, wanted from {min} to {max}"
        );
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn a_ray_through_the_centre_hits() {
        let ray = Ray::new(vec3(-3.0, 0.0, 0.0), Vec3::X);
        let inside = cube().hit(&ray, Interval::AHEAD);
        assert_inside(inside, 2.0, 4.0);
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn the_answer_is_clipped_to_times() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        let inside = cube().hit(&ray, Interval::new(0.25, 9.0));
        assert_inside(inside, 0.25, 1.0);
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn a_ray_must_be_in_all_slabs_at_once() {
        // It leaves the x slab before it enters the y slab.
        let ray = Ray::new(vec3(0.0, -4.0, 0.0), vec3(1.0, 1.0, 0.0));
        assert_eq!(cube().hit(&ray, Interval::AHEAD), None, "it misses the box");
    }
}
