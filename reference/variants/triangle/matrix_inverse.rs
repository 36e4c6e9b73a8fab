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
        (inside && ray.range.contains(t)).then(|| self.trace(ray, t, u, v))
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
