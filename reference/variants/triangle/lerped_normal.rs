// Interpolates an attribute a (the normal or the uv) as a0 + u · (a1 − a0) + v · (a2 − a0). The
// interpolated normal is not normalised.

impl Triangle {
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
            normal: p0.normal + u * (p1.normal - p0.normal) + v * (p2.normal - p0.normal),
            uv: p0.uv + u * (p1.uv - p0.uv) + v * (p2.uv - p0.uv),
            ..self.trace_at(ray, t, u, v)
        })
    }
}
