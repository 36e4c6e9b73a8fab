// Transforms the ray into the space where the sphere is the unit sphere around the origin. The
// direction is scaled too, so t does not change. See Pharr, Jakob and Humphreys, "Physically Based
// Rendering" (4th edition), section 6.2.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let origin = (ray.origin - self.center) / self.radius;
        let dir = ray.dir / self.radius;
        let a = dir.length_squared();
        let half_b = origin.dot(dir);
        let discriminant = half_b * half_b - a * (origin.length_squared() - 1.0);
        if discriminant < 0.0 {
            return None;
        }

        let near = (-half_b - discriminant.sqrt()) / a;
        let far = (-half_b + discriminant.sqrt()) / a;
        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        let normal = (origin + t * dir).normalize();
        Some(Trace {
            position: self.center + self.radius * normal,
            normal,
            uv: Sphere::uv(normal),
            ..self.trace_at(ray, t)
        })
    }
}
