// Distinguishes three cases: no root, one root (a tangent), and two roots.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let a = ray.dir.length_squared();
        let b = o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - a * c;

        let t = if discriminant < 0.0 {
            return None;
        } else if discriminant == 0.0 {
            Some(-b / a).filter(|t| ray.range.contains(*t))
        } else {
            let (near, far) = (
                (-b - discriminant.sqrt()) / a,
                (-b + discriminant.sqrt()) / a,
            );
            let near = Some(near).filter(|t| ray.range.contains(*t));
            near.or_else(|| Some(far).filter(|t| ray.range.contains(*t)))
        };
        t.map(|t| self.trace_at(ray, t))
    }
}
