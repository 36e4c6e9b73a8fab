//! Interpolates an attribute a (the normal or the uv) as a0 + u · (a1 − a0) + v · (a2 − a0). The
//! interpolated normal is not normalised.

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

        let p = ray.dir.cross(e2);
        let determinant = e1.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let s = ray.origin - self.p0.position;
        let q = s.cross(e1);
        let u = s.dot(p) / determinant;
        let v = ray.dir.dot(q) / determinant;
        let t = e2.dot(q) / determinant;
        if u < 0.0 || v < 0.0 || u + v > 1.0 || !ray.range.contains(t) {
            return None;
        }

        let Triangle { p0, p1, p2, .. } = self;
        Some(Trace {
            distance: t,
            position: ray.at(t),
            normal: p0.normal + u * (p1.normal - p0.normal) + v * (p2.normal - p0.normal),
            uv: p0.uv + u * (p1.uv - p0.uv) + v * (p2.uv - p0.uv),
            origin: ray.origin,
            material: self.material,
        })
    }
}
