// Uses the complete quadratic formula, (−b ± √(b² − 4ac)) / 2a.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let a = ray.dir.dot(ray.dir);
        let b = 2.0 * o.dot(ray.dir);
        let c = o.dot(o) - self.radius.powi(2);
        let discriminant = b * b - 4.0 * a * c;
        if discriminant < 0.0 {
            return None;
        }

        let near = (-b - discriminant.sqrt()) / (2.0 * a);
        let far = (-b + discriminant.sqrt()) / (2.0 * a);
        let t = if ray.range.contains(near) {
            near
        } else if ray.range.contains(far) {
            far
        } else {
            return None;
        };
        Some(self.trace_at(ray, t))
    }
}
