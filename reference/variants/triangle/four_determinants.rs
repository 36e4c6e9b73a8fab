//! Applies Cramer's rule as in a textbook: computes the determinant of the matrix, and those of
//! three matrices with one column replaced.

use glam::{Mat3, Vec3};
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
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let s = ray.origin - self.p0.position;
        let det = |a: Vec3, b: Vec3, c: Vec3| Mat3::from_cols(a, b, c).determinant();

        let all = det(e1, e2, -ray.dir);
        if all == 0.0 {
            return None;
        }
        let u = det(s, e2, -ray.dir) / all;
        let v = det(e1, s, -ray.dir) / all;
        let t = det(e1, e2, s) / all;
        if u < 0.0 || v < 0.0 || u + v > 1.0 || !ray.range.contains(t) {
            return None;
        }
        Some(self.trace(ray, t, u, v))
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
