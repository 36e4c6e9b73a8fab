// Computes two edges and the face normal once, in `new`, and stores them in private fields.

use glam::Vec3;

#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub p0: Vertex,
    pub p1: Vertex,
    pub p2: Vertex,
    pub shape: u32,
    /// The edge from p0 to p1.
    e1: Vec3,
    /// The edge from p0 to p2.
    e2: Vec3,
    /// The face normal: the cross product of the edges.
    face: Vec3,
}

impl Triangle {
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, shape: u32) -> Self {
        let e1 = p1.position - p0.position;
        let e2 = p2.position - p0.position;
        Triangle {
            p0,
            p1,
            p2,
            shape,
            e1,
            e2,
            face: e1.cross(e2),
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // Cramer's rule: the determinant of the three equations, and the determinants where s
        // replaces a column.
        let determinant = -self.face.dot(ray.dir);
        if determinant == 0.0 {
            return None;
        }
        let s = ray.origin - self.p0.position;
        let t = self.face.dot(s) / determinant;
        if !ray.range.contains(t) {
            return None;
        }

        let s_x_d = s.cross(ray.dir);
        let u = self.e2.dot(s_x_d) / determinant;
        let v = -self.e1.dot(s_x_d) / determinant;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| self.trace_at(ray, t, u, v))
    }
}
