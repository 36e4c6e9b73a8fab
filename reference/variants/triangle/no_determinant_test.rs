// Doesn't test the determinant. If it is zero, the weights or t are infinite or NaN and fail the
// range tests, which are written so that NaN fails too.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let s = ray.origin - self.p0.position;
        let e1_x_d = e1.cross(ray.dir);
        let s_x_e2 = s.cross(e2);

        let solution = Vec3::new(-s_x_e2.dot(ray.dir), e1_x_d.dot(s), -s_x_e2.dot(e1));
        let (u, v, t) = (solution / e1_x_d.dot(e2)).into();

        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
