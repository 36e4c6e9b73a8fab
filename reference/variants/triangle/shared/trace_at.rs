impl Triangle {
    /// Returns the trace for the hit at distance `t`, where p1 has the weight `u` and p2 has `v`.
    fn trace_at(&self, ray: &Ray, t: f32, u: f32, v: f32) -> Trace {
        let w = 1.0 - u - v;
        Trace {
            distance: t,
            position: ray.at(t),
            normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),
            uv: w * self.p0.uv + u * self.p1.uv + v * self.p2.uv,
            origin: ray.origin,
            shape: self.shape,
        }
    }
}
