// Uses an iterator over the two signs to find the smallest root in the range.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let b = o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - c;
        [1.0, -1.0]
            .into_iter()
            .filter(|_| discriminant >= 0.0)
            .map(|sign| -b + sign * discriminant.sqrt())
            .filter(|t| ray.range.contains(*t))
            .min_by(f32::total_cmp)
            .map(|t| self.trace_at(ray, t))
    }
}
