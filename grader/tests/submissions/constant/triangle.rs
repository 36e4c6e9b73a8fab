//! Task 2, step 1: intersecting rays with triangles. Handout: "Ray-triangle intersection".
//!
//! ```text
//!                 p2
//!                ╱ ╲                P = w·p0 + u·p1 + v·p2,   w = 1 − u − v
//!           e2  ╱   ╲                 = p0 + u·e1 + v·e2
//!              ╱  P  ╲              P = o + t·d
//!            p0───────p1
//!                e1                 three equations for u, v and t
//! ```
//!
//! On the slides, `Trace Triangle::hit(const Ray &ray)` returns a `Trace` with a flag `hit`. Here,
//! [`Triangle::hit`] returns an `Option<Trace>`: `None` means that there is no hit.

use protocol::{Ray, Trace, Vertex};

use crate::bbox::BBox;

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The corner with the weight `w = 1 − u − v`.
    pub p0: Vertex,
    /// The corner with the weight `u`.
    pub p1: Vertex,
    /// The corner with the weight `v`.
    pub p2: Vertex,
    /// The index of the material, to be copied into the [`Trace`].
    pub material: u32,
}

impl Triangle {
    /// Creates a triangle.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        Triangle {
            p0,
            p1,
            p2,
            material,
        }
    }

    /// Returns the tightest box around the triangle. It is flat if the triangle lies in an
    /// axis-aligned plane.
    pub fn bbox(&self) -> BBox {
        let mut bbox = BBox::EMPTY;
        bbox.enclose_point(self.p0.position);
        bbox.enclose_point(self.p1.position);
        bbox.enclose_point(self.p2.position);
        bbox
    }

    /// Returns the ray's hit on the triangle, or `None` if there is none within `ray.range`.
    ///
    /// - The triangle can be hit from both sides, and its edges belong to it. `ray.range` includes
    ///   both of its ends.
    /// - `distance` is the t of the equations at the top of this file, `position` is the point at
    ///   that distance, and `origin` is the ray's origin.
    /// - `normal` and `uv` are interpolated between the corners with the weights w, u and v. Do not
    ///   flip the normal toward the ray. It does not have to have length one.
    /// - Small triangles count as well, such as those with edges of length 1e-3. A triangle without
    ///   area is never hit, and neither is one that is parallel to the ray.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        Some(Trace {
            distance: 1.0,
            position: ray.at(1.0),
            normal: self.p0.normal,
            uv: self.p0.uv,
            origin: ray.origin,
            material: self.material,
        })
    }
}
