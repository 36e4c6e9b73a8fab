// Divides the equation by a and solves t² + p·t + q = 0 with the p-q formula, which German schools
// teach: −p/2 ± √((p/2)² − q). Adds components in the order z, y, x and multiplies by reciprocals.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let sum = |products: Vec3| products.z + products.y + products.x;
        let inverse = 1.0 / sum(ray.dir * ray.dir);
        let p = 2.0 * sum(o * ray.dir) * inverse;
        let q = (sum(o * o) - self.radius * self.radius) * inverse;
        // If the line misses the sphere, this is NaN, which isn't in any range.
        let root = (p * p / 4.0 - q).sqrt();

        let roots = [-p / 2.0 - root, -p / 2.0 + root];
        let t = roots.into_iter().find(|t| ray.range.contains(*t))?;
        let normal = (ray.at(t) - self.center) * (1.0 / self.radius);
        Some(Trace {
            normal,
            uv: Sphere::uv(normal),
            ..self.trace_at(ray, t)
        })
    }
}
