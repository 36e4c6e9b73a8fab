// Computes the position as the weighted sum of the corners, like normal and uv, so that it is in
// the plane even if the ray starts far away.

use glam::{Vec2, Vec3};

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

        let mut trace = Trace {
            distance: t,
            position: Vec3::ZERO,
            normal: Vec3::ZERO,
            uv: Vec2::ZERO,
            origin: ray.origin,
            shape: self.shape,
        };
        for (weight, corner) in weights.into_iter().zip([self.p0, self.p1, self.p2]) {
            trace.position += weight * corner.position;
            trace.normal += weight * corner.normal;
            trace.uv += weight * corner.uv;
        }
        trace.normal = trace.normal.normalize();
        Some(trace)
    }
}
