//! Task 3, step 0: intersecting rays with bounding boxes. Handout: "Ray-box intersection".
//!
//! ```text
//!                    │ x slab  │
//!         ───────────┌─────────┐─── max
//!           y slab   │    ╱    │
//!         ───────────└───╱─────┘───
//!                min │  ╱      │       inside the box = inside all three slabs at once
//!                      o
//! ```
//!
//! On the slides, `bool BBox::hit(const Ray &ray, Vec2 &times)` changes `times`. Here, `times` is
//! not changed, and [`BBox::hit`] returns an `Option<Interval>` with the new times, or `None`.

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
    ///
    /// - Use `times` and ignore `ray.range`. The result is clipped to `times`: if the ray is
    ///   already inside the box at `times.min`, the result starts there, and if it is inside during
    ///   all of `times`, the result is `times`.
    /// - A component of `ray.dir` can be 0 or −0. Then the ray is parallel to that slab: it is
    ///   inside the slab at all times, or never.
    /// - A flat box (`min == max` along an axis) can be hit, too.
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        // solution
        // starter: todo!("task 3, bbox: when, within {times:?}, is {ray:?} inside {self:?}?")
        // Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986: the ray is inside the box
        // from the last entry into a slab until the first exit from one. `Vec3A` processes all
        // three axes in one SIMD register, which halves the number of instructions. The fourth
        // lane is ignored: setting it to 0 is cheaper than repeating z, as `to_vec3a` does.
        //
        // If a component of the direction is 0, the division gives infinities. Between the planes
        // of the slab they are −∞ and ∞, so this slab limits nothing. Outside they have the same
        // sign, so the result is empty.
        let in_register = |v: Vec3| glam::Vec3A::from_vec4(v.extend(0.0));
        let (min, max) = (in_register(self.min), in_register(self.max));
        let (origin, dir) = (in_register(ray.origin), in_register(ray.dir));
        let inverse = dir.recip();
        let at_min = (min - origin) * inverse;
        let at_max = (max - origin) * inverse;
        let enter = at_min.min(at_max).max_element();
        let leave = at_min.max(at_max).min_element();

        // `f32::max` and `f32::min` would take three instructions each, because they handle NaN.
        let inside = Interval::new(
            if enter > times.min { enter } else { times.min },
            if leave < times.max { leave } else { times.max },
        );
        (inside.min <= inside.max).then_some(inside)
        // end solution
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
    fn assert_times(got: Option<Interval>, min: f32, max: f32) {
        let close = |got: Interval| (got.min - min).abs() < 1e-5 && (got.max - max).abs() < 1e-5;
        assert!(
            got.is_some_and(close),
            "expected the times from {min} to {max}, got {got:?}"
        );
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn a_ray_through_the_centre_hits() {
        let ray = Ray::new(vec3(-3.0, 0.0, 0.0), Vec3::X);
        let inside = cube().hit(&ray, Interval::AHEAD);
        assert_times(inside, 2.0, 4.0);
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn the_answer_is_clipped_to_times() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        let inside = cube().hit(&ray, Interval::new(0.25, 9.0));
        assert_times(inside, 0.25, 1.0);
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn a_ray_must_be_in_all_slabs_at_once() {
        // This ray leaves the x slab before it enters the y slab.
        let ray = Ray::new(vec3(0.0, -4.0, 0.0), vec3(1.0, 1.0, 0.0));
        let inside = cube().hit(&ray, Interval::AHEAD);
        assert!(inside.is_none(), "expected None, got {inside:?}");
    }
}
