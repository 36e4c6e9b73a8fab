// Computes the position as a weighted sum over the corners, like the normal and the uv, so that the
// position is in the plane even if the ray starts far away.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let s = ray.origin - self.p0.position;
        let e1_x_d = e1.cross(ray.dir);
        let s_x_e2 = s.cross(e2);
        let determinant = e1_x_d.dot(e2);
        if determinant == 0.0 {
            return None;
        }

        let u = -s_x_e2.dot(ray.dir) / determinant;
        let v = e1_x_d.dot(s) / determinant;
        let t = -s_x_e2.dot(e1) / determinant;
        let weights = [1.0 - u - v, u, v];
        if weights.iter().any(|weight| *weight < 0.0) || !ray.range.contains(t) {
            return None;
        }

        let corners = [self.p0, self.p1, self.p2].map(|corner| corner.position);
        let weighted = weights.into_iter().zip(corners);
        Some(Trace {
            position: weighted.map(|(weight, corner)| weight * corner).sum(),
            ..self.trace_at(ray, t, u, v)
        })
    }
}
