impl Sphere {
    /// Returns the trace for the hit at distance `t`.
    fn trace_at(&self, ray: &Ray, t: f32) -> Trace {
        let position = ray.at(t);
        let normal = (position - self.center).normalize();
        Trace {
            distance: t,
            position,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            shape: self.shape,
        }
    }
}
