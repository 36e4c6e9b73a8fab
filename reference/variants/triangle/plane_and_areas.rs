//! Intersects the plane first. The weights are computed from the signed areas of the three
//! triangles that the point forms with the edges. See Marschner and Shirley, "Fundamentals of
//! Computer Graphics" (4th edition), section 2.7.2.

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

        let face = e1.cross(e2);
        let slope = face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = face.dot(self.p0.position - ray.origin) / slope;
        if !ray.range.contains(t) {
            return None;
        }

        let point = ray.at(t);
        let part = |from: Vertex, to: Vertex| {
            let area = (to.position - from.position).cross(point - from.position);
            area.dot(face) / face.length_squared()
        };
        let (w, u, v) = (
            part(self.p1, self.p2),
            part(self.p2, self.p0),
            part(self.p0, self.p1),
        );
        (w >= 0.0 && u >= 0.0 && v >= 0.0).then(|| self.trace(ray, t, u, v))
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
