// Applies Cramer's rule as in a textbook: computes the determinant of the matrix, and those of
// three matrices with one column replaced.

use glam::{Mat3, Vec3};

impl Triangle {
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
        Some(self.trace_at(ray, t, u, v))
    }
}
