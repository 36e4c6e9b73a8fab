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

        let position = ray.at(t);
        let normal = (position - self.center) / self.radius;
        Some(Trace {
            distance: t,
            position,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            shape: self.shape,
        })
    }
}
