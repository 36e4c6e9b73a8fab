// Tries the roots in turn with a macro that returns from the method.

/// Makes the calling method return the trace at a distance if that distance is in the ray's range.
macro_rules! return_if_in_range {
    ($sphere:expr, $ray:expr, $t:expr) => {
        let t = $t;
        if t >= $ray.range.min && t <= $ray.range.max {
            return Some($sphere.trace_at($ray, t));
        }
    };
}

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let a = ray.dir.length_squared();
        let b = 2.0 * o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - 4.0 * a * c;
        if discriminant >= 0.0 {
            return_if_in_range!(self, ray, (-b - discriminant.sqrt()) / (2.0 * a));
            return_if_in_range!(self, ray, (-b + discriminant.sqrt()) / (2.0 * a));
        }
        None
    }
}
