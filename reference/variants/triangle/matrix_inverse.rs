// Solves the three equations u·e1 + v·e2 − t·d = s with the inverse of their matrix.

use glam::Mat3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let equations = Mat3::from_cols(
            self.p1.position - self.p0.position,
            self.p2.position - self.p0.position,
            -ray.dir,
        );
        if equations.determinant() == 0.0 {
            return None;
        }

        let s = ray.origin - self.p0.position;
        let (u, v, t) = (equations.inverse() * s).into();
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
