//! Computes signed volumes: the sign of the scalar triple product of the ray's direction and two
//! corners tells on which side of their edge the ray passes (Ericson, "Real-Time Collision
//! Detection", section 5.3.4). Here, the edge itself is used instead of one of the corners, since
//! rounding errors would otherwise be too large for small triangles.

use glam::Vec3;
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
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let a = self.p0.position - ray.origin;
        let b = self.p1.position - ray.origin;
        let c = self.p2.position - ray.origin;
        // d · (to × from) = d · ((to − from) × from)
        let volume = |from: Vec3, to: Vec3| ray.dir.dot((to - from).cross(from));

        let (w, u, v) = (volume(b, c), volume(c, a), volume(a, b));
        let sum = u + v + w;
        if sum == 0.0 {
            return None;
        }
        let (w, u, v) = (w / sum, u / sum, v / sum);
        if w < 0.0 || u < 0.0 || v < 0.0 {
            return None;
        }

        // The weighted sum of the corners is on the ray, whose direction has length one.
        let t = (w * a + u * b + v * c).dot(ray.dir);
        ray.range.contains(t).then(|| self.trace(ray, t, u, v))
    }

    /// Returns the trace for the hit at distance `t`, where p1 has the weight `u` and p2 has `v`.
    fn trace(&self, ray: &Ray, t: f32, u: f32, v: f32) -> Trace {
        let w = 1.0 - u - v;
        Trace {
            distance: t,
            position: ray.at(t),
            normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),
            uv: w * self.p0.uv + u * self.p1.uv + v * self.p2.uv,
            origin: ray.origin,
            material: self.material,
        }
    }
}
