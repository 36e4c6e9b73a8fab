// Computes the discriminant from the vector between the centre and the closest point on the ray,
// which is perpendicular to the ray. This avoids the cancellation in b² − c. See Haines, Günther
// and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// chapter 7, 2019.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let b = -o.dot(ray.dir);
        let across = o + b * ray.dir;
        let discriminant = self.radius * self.radius - across.length_squared();
        if discriminant < 0.0 {
            return None;
        }

        let c = o.length_squared() - self.radius * self.radius;
        let q = b + discriminant.sqrt().copysign(b);
        let (near, far) = if b < 0.0 { (q, c / q) } else { (c / q, q) };

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
