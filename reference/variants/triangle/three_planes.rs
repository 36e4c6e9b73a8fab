//! Three planes, made once: the triangle's own, and two across it whose distances are u and v.
//! Havel and Herout, "Yet Faster Ray-Triangle Intersection (Using SSE4)", IEEE TVCG 16(3), 2010;
//! here with p0 for origin, so that no plane needs an offset.

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
    /// Normal of the triangle's plane.
    face: Vec3,
    /// 1 at p1, 0 at p0 and p2.
    u_plane: Vec3,
    /// 1 at p2, 0 at p0 and p1.
    v_plane: Vec3,
}

impl Triangle {
    /// A triangle from its parts.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        let e1 = p1.position - p0.position;
        let e2 = p2.position - p0.position;
        let face = e1.cross(e2);
        Triangle {
            p0,
            p1,
            p2,
            material,
            face,
            u_plane: e2.cross(face) / face.length_squared(),
            v_plane: face.cross(e1) / face.length_squared(),
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
        let s = ray.origin - self.p0.position;
        let slope = self.face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = -self.face.dot(s) / slope;
        let place = s + t * ray.dir;
        let (u, v) = (self.u_plane.dot(place), self.v_plane.dot(place));
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace(ray, t, u, v))
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
