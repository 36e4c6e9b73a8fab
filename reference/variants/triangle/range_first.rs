// Tests t first, and then the weights in the order w, v, u.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let s = ray.origin - self.p0.position;
        let d_x_e2 = ray.dir.cross(e2);
        let s_x_e1 = s.cross(e1);
        let determinant = e1.dot(d_x_e2);
        if determinant == 0.0 {
            return None;
        }

        let t = e2.dot(s_x_e1) / determinant;
        if !ray.range.contains(t) {
            return None;
        }
        let u = s.dot(d_x_e2) / determinant;
        let v = ray.dir.dot(s_x_e1) / determinant;
        if 1.0 - u - v < 0.0 || v < 0.0 || u < 0.0 {
            return None;
        }
        Some(self.trace(ray, t, u, v))
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
