//! Task 2, step 1: rays against triangles. Handout: "Where a ray meets a triangle".
//!
//! ```text
//!                 p2
//!                ╱ ╲                P = w·p0 + u·p1 + v·p2,   w = 1 − u − v
//!           e2  ╱   ╲                 = p0 + u·e1 + v·e2
//!              ╱  P  ╲              P = o + t·d
//!            p0───────p1
//!                e1                 three equations for u, v and t
//! ```

use protocol::{Ray, Trace, Vertex};

use crate::bbox::BBox;

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The corner with weight `w = 1 − u − v`.
    pub p0: Vertex,
    /// The corner with weight `u`.
    pub p1: Vertex,
    /// The corner with weight `v`.
    pub p2: Vertex,
    /// What it is made of, for the [`Trace`].
    pub material: u32,
}

impl Triangle {
    /// A triangle from its parts.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        Triangle {
            p0,
            p1,
            p2,
            material,
        }
    }

    /// The tightest box around the triangle; flat if the triangle lies along an axis.
    pub fn bbox(&self) -> BBox {
        let mut bbox = BBox::EMPTY;
        bbox.enclose_point(self.p0.position);
        bbox.enclose_point(self.p1.position);
        bbox.enclose_point(self.p2.position);
        bbox
    }

    /// Where the ray meets the triangle within `ray.range`, if anywhere.
    ///
    /// - Both sides count, and so do the edges. `ray.range` includes its ends.
    /// - `distance` is the algorithm's t; `position` the point there; `origin` the ray's.
    /// - `normal` and `uv` are interpolated between the corners with weights w, u, v. The normal
    ///   is never flipped toward the ray, and need not be brought to length one.
    /// - A triangle of edge 1e-3 is as good as any. One without area, or one that the ray is
    ///   parallel to, is not met.
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
