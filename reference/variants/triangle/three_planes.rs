// Computes three planes once: the triangle's own plane and two planes perpendicular to it. The
// scaled distances from the perpendicular planes are u and v. See Havel and Herout, "Yet Faster
// Ray-Triangle Intersection (Using SSE4)", IEEE TVCG 16(3), 2010. Here, the planes are relative to
// p0, so they don't need an offset.

use glam::Vec3;

#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub p0: Vertex,
    pub p1: Vertex,
    pub p2: Vertex,
    pub shape: u32,
    /// The normal of the triangle's plane.
    face: Vec3,
    /// The normal of the plane through p0 and p2, scaled so that p1 is at distance 1.
    u_plane: Vec3,
    /// The normal of the plane through p0 and p1, scaled so that p2 is at distance 1.
    v_plane: Vec3,
}

impl Triangle {
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, shape: u32) -> Self {
        let e1 = p1.position - p0.position;
        let e2 = p2.position - p0.position;
        let face = e1.cross(e2);
        Triangle {
            p0,
            p1,
            p2,
            shape,
            face,
            u_plane: e2.cross(face) / face.length_squared(),
            v_plane: face.cross(e1) / face.length_squared(),
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let s = ray.origin - self.p0.position;
        let slope = self.face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = -self.face.dot(s) / slope;
        let point = s + t * ray.dir;
        let (u, v) = (self.u_plane.dot(point), self.v_plane.dot(point));
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
