// Leaves out the coefficient a, which is 1 because directions have length one. A negative
// discriminant doesn't need a test: its square root is NaN, which isn't in any range.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let to_center = self.center - ray.origin;
        let b = to_center.dot(ray.dir);
        let root = (b * b - to_center.length_squared() + self.radius * self.radius).sqrt();
        let (near, far) = (b - root, b + root);

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
