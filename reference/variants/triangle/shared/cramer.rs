impl Triangle {
    /// Solves the three equations u·e1 + v·e2 − t·d = s by Cramer's rule. `det` returns the
    /// determinant of the matrix whose columns are its three arguments.
    fn cramer(
        &self,
        ray: &Ray,
        det: impl Fn(glam::Vec3, glam::Vec3, glam::Vec3) -> f32,
    ) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let s = ray.origin - self.p0.position;
        let all = det(e1, e2, -ray.dir);
        if all == 0.0 {
            return None;
        }
        let u = det(s, e2, -ray.dir) / all;
        let v = det(e1, s, -ray.dir) / all;
        let t = det(e1, e2, s) / all;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
