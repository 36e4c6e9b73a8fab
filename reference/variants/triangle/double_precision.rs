// Computes everything in double precision and rounds once at the end.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let [p0, p1, p2] = [self.p0, self.p1, self.p2].map(|corner| corner.position.as_dvec3());
        let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        let (e1, e2, s) = (p1 - p0, p2 - p0, origin - p0);

        let p = dir.cross(e2);
        let q = s.cross(e1);
        let determinant = e1.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let u = s.dot(p) / determinant;
        let v = dir.dot(q) / determinant;
        let w = 1.0 - u - v;
        let t = e2.dot(q) / determinant;
        if w < 0.0 || u < 0.0 || v < 0.0 || !ray.range.contains(t as f32) {
            return None;
        }

        let [n0, n1, n2] = [self.p0, self.p1, self.p2].map(|corner| corner.normal.as_dvec3());
        let [uv0, uv1, uv2] = [self.p0, self.p1, self.p2].map(|corner| corner.uv.as_dvec2());
        Some(Trace {
            distance: t as f32,
            position: (origin + t * dir).as_vec3(),
            normal: (w * n0 + u * n1 + v * n2).normalize().as_vec3(),
            uv: (w * uv0 + u * uv1 + v * uv2).as_vec2(),
            origin: ray.origin,
            shape: self.shape,
        })
    }
}
