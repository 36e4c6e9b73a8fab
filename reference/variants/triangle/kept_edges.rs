//! Edges and face normal are computed once, in `new`, and kept in private fields.

use glam::Vec3;
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
    /// From p0 to p1.
    e1: Vec3,
    /// From p0 to p2.
    e2: Vec3,
    /// Their cross product.
    face: Vec3,
}

impl Triangle {
    /// A triangle from its parts.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        let e1 = p1.position - p0.position;
        let e2 = p2.position - p0.position;
        Triangle {
            p0,
            p1,
            p2,
            material,
            e1,
            e2,
            face: e1.cross(e2),
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
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // The determinant of the three equations, and each with s in place of a column.
        let determinant = -self.face.dot(ray.dir);
        if determinant == 0.0 {
            return None;
        }
        let inverse = 1.0 / determinant;
        let s = ray.origin - self.p0.position;
        let t = self.face.dot(s) * inverse;
        if !ray.range.contains(t) {
            return None;
        }

        let s_x_d = s.cross(ray.dir);
        let u = self.e2.dot(s_x_d) * inverse;
        let v = -self.e1.dot(s_x_d) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| self.trace(ray, t, u, v))
    }

    /// What is to be told of the place at distance `t`, where p1 weighs `u` and p2 weighs `v`.
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
