// Uses fused multiply-adds everywhere. For the discriminant b² − a·c, this follows Kahan, "On the
// Cost of Floating-Point Computation Without Extra-Precise Arithmetic", 2004: a fused multiply-add
// computes the exact rounding error of the product a·c, which is then subtracted.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let (a, b) = (dot(ray.dir, ray.dir), dot(o, ray.dir));
        let c = self.radius.mul_add(-self.radius, dot(o, o));
        let product = a * c;
        let discriminant = b.mul_add(b, -product) - a.mul_add(c, -product);
        if discriminant < 0.0 {
            return None;
        }

        let roots = [-discriminant.sqrt(), discriminant.sqrt()].map(|root| (root - b) / a);
        let t = roots.into_iter().find(|t| ray.range.contains(*t))?;
        let position = ray.dir.mul_add(Vec3::splat(t), ray.origin);
        let normal = (position - self.center).normalize();
        Some(Trace {
            position,
            normal,
            uv: Sphere::uv(normal),
            ..self.trace_at(ray, t)
        })
    }
}

/// Returns the dot product with only three roundings.
fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x.mul_add(b.x, a.y.mul_add(b.y, a.z * b.z))
}
