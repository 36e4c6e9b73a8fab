// Tests t first and then the weights in the order w, v, u.

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
        Some(self.trace_at(ray, t, u, v))
    }
}
