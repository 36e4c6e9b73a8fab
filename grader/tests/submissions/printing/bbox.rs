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
        // Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986: the ray is inside the box
        // from the last entry into a slab until the first exit from one.
        //
        // If a component of the direction is 0, the division gives infinities. Between the planes
        // of the slab they are −∞ and ∞, so this slab limits nothing. Outside they have the same
        // sign, so the result is empty.
        println!("asking {self:?} for {ray:?}");
        let inverse = ray.dir.recip();
        let at_min = (self.min - ray.origin) * inverse;
        let at_max = (self.max - ray.origin) * inverse;
        let enter = at_min.min(at_max).max_element();
        let leave = at_min.max(at_max).min_element();

        let inside = Interval::new(times.min.max(enter), times.max.min(leave));
        (inside.min <= inside.max).then_some(inside)
    }
}
