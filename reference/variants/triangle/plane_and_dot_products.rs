// Intersects the ray with the triangle's plane first, then computes the weights from two equations
// whose terms are dot products with the edges. See Ericson, "Real-Time Collision Detection",
// section 3.4.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let face = e1.cross(e2);
        let slope = face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = face.dot(self.p0.position - ray.origin) / slope;
        let point = ray.at(t) - self.p0.position;

        let (d11, d12, d22) = (e1.dot(e1), e1.dot(e2), e2.dot(e2));
        let (d1, d2) = (point.dot(e1), point.dot(e2));
        let determinant = d11 * d22 - d12 * d12;
        let u = (d22 * d1 - d12 * d2) / determinant;
        let v = (d11 * d2 - d12 * d1) / determinant;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
