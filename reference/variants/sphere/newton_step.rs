// Defines a type for the quadratic polynomial and improves each root by one step of Newton's
// method.

/// The polynomial a·t² + 2b·t + c.
struct Quadratic {
    a: f32,
    b: f32,
    c: f32,
}

impl Quadratic {
    /// Returns the two roots in increasing order.
    fn roots(&self) -> Option<[f32; 2]> {
        let root = (self.b * self.b - self.a * self.c).sqrt();
        let roots = [-self.b - root, -self.b + root].map(|root| self.improve(root / self.a));
        (!root.is_nan()).then_some(roots)
    }

    fn improve(&self, t: f32) -> f32 {
        let value = (self.a * t + 2.0 * self.b) * t + self.c;
        let slope = 2.0 * (self.a * t + self.b);
        if slope == 0.0 { t } else { t - value / slope }
    }
}

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let polynomial = Quadratic {
            a: ray.dir.length_squared(),
            b: o.dot(ray.dir),
            c: o.length_squared() - self.radius * self.radius,
        };
        let in_range = |t: &f32| ray.range.contains(*t);
        let t = polynomial.roots()?.into_iter().find(in_range)?;
        Some(self.trace_at(ray, t))
    }
}
