// Computes the normal by dividing the vector from the centre to the hit by the radius. The result
// has length one except for rounding.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let b = o.dot(ray.dir);
        let c = o.dot(o) - self.radius * self.radius;
        let discriminant = b * b - c;
        if discriminant < 0.0 {
            return None;
        }

        let root = discriminant.sqrt();
        let mut t = -b - root;
        if !ray.range.contains(t) {
            t = -b + root;
        }
        if !ray.range.contains(t) {
            return None;
        }

        let normal = (ray.at(t) - self.center) / self.radius;
        Some(Trace {
            normal,
            uv: Sphere::uv(normal),
            ..self.trace_at(ray, t)
        })
    }
}
