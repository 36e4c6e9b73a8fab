//! Normal and uv are p0's, plus u and v times the way to the others'; the normal is left at
//! whatever length that gives.

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
