//! Computes the position as the weighted sum of the corners, like normal and uv, so that it is in
//! the plane even if the ray starts far away.

use glam::{Vec2, Vec3};
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
        let e1_x_d = e1.cross(ray.dir);
        let s_x_e2 = s.cross(e2);
        let determinant = e1_x_d.dot(e2);
        if determinant == 0.0 {
            return None;
        }

        let u = -s_x_e2.dot(ray.dir) / determinant;
        let v = e1_x_d.dot(s) / determinant;
        let t = -s_x_e2.dot(e1) / determinant;
        let weights = [1.0 - u - v, u, v];
        if weights.iter().any(|weight| *weight < 0.0) || !ray.range.contains(t) {
            return None;
        }

        let mut trace = Trace {
            distance: t,
            position: Vec3::ZERO,
            normal: Vec3::ZERO,
            uv: Vec2::ZERO,
            origin: ray.origin,
            material: self.material,
        };
        for (weight, corner) in weights.into_iter().zip([self.p0, self.p1, self.p2]) {
            trace.position += weight * corner.position;
            trace.normal += weight * corner.normal;
            trace.uv += weight * corner.uv;
        }
        trace.normal = trace.normal.normalize();
        Some(trace)
    }
}
