// Chooses the root with a `match`, depending on which of the two roots are in the range.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let (near, far) = self.roots(ray)?;
        match (ray.range.contains(near), ray.range.contains(far)) {
            (true, _) => Some(self.trace_at(ray, near)),
            (false, true) => Some(self.trace_at(ray, far)),
            (false, false) => None,
        }
    }

    /// Returns the distances at which the ray's line enters and leaves the sphere, or `None` if the
    /// line misses the sphere.
    fn roots(&self, ray: &Ray) -> Option<(f32, f32)> {
        let o = ray.origin - self.center;
        let b = o.dot(ray.dir);
        let c = (o.length() - self.radius) * (o.length() + self.radius);
        let discriminant = b * b - c;
        (discriminant >= 0.0).then(|| (-b - discriminant.sqrt(), -b + discriminant.sqrt()))
    }
}
