// Solves the quadratic equation in a numerically stable way: computes the root of larger magnitude
// first, and the other root from near · far = c / a. See Press et al., "Numerical Recipes" (3rd
// edition), section 5.6.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let a = ray.dir.length_squared();
        let b = 2.0 * o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - 4.0 * a * c;
        if discriminant < 0.0 {
            return None;
        }

        let q = -0.5 * (b + b.signum() * discriminant.sqrt());
        let (one, other) = (q / a, c / q);
        let (near, far) = (one.min(other), one.max(other));

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
