// Defines a function for this file and triangle.rs. It returns the first of several distances that
// is in the ray's range.

/// Returns the first of these distances that is in the ray's range.
pub fn first_in_range<const N: usize>(ray: &Ray, distances: [f32; N]) -> Option<f32> {
    distances.into_iter().find(|t| ray.range.contains(*t))
}

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let b = o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - c;
        if discriminant < 0.0 {
            return None;
        }
        let t = first_in_range(ray, [-b - discriminant.sqrt(), -b + discriminant.sqrt()])?;
        Some(self.trace_at(ray, t))
    }
}
