// Computes the determinant as the dot product of the face normal and −d. Tests the weights before
// the only division. This follows Ericson, "Real-Time Collision Detection", section 5.3.6, but
// accepts hits on both sides.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let back = -ray.dir;
        let face = e1.cross(e2);
        let determinant = face.dot(back);
        if determinant == 0.0 {
            return None;
        }
        // For a ray from behind, all signs are reversed.
        let side = determinant.signum();

        let s = ray.origin - self.p0.position;
        let back_x_s = back.cross(s);
        let u = side * e2.dot(back_x_s);
        let v = side * -e1.dot(back_x_s);
        if u < 0.0 || v < 0.0 || u + v > determinant.abs() {
            return None;
        }

        let inverse = 1.0 / determinant.abs();
        let t = side * s.dot(face) * inverse;
        ray.range
            .contains(t)
            .then(|| self.trace_at(ray, t, u * inverse, v * inverse))
    }
}
