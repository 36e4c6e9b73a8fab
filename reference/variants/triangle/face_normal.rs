//! Computes the determinant as the dot product of the face normal and −d, and tests the weights
//! before the only division. This follows Ericson, "Real-Time Collision Detection", section 5.3.6,
//! but accepts hits on both sides.

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

        let back = -ray.dir;
        let face = e1.cross(e2);
        let determinant = face.dot(back);
        if determinant == 0.0 {
            return None;
        }
        // For a ray from behind, all signs are reversed.
        let side = determinant.signum();

        let s = ray.origin - self.p0.position;
        let back_x_s = back.cross(s);
        let u = side * e2.dot(back_x_s);
        let v = side * -e1.dot(back_x_s);
        if u < 0.0 || v < 0.0 || u + v > determinant.abs() {
            return None;
        }

        let inverse = 1.0 / determinant.abs();
        let t = side * s.dot(face) * inverse;
        ray.range
            .contains(t)
            .then(|| self.trace(ray, t, u * inverse, v * inverse))
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
