// Computes the slabs in double precision and rounds once at the end.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        let to_min = (self.min.as_dvec3() - origin) / dir;
        let to_max = (self.max.as_dvec3() - origin) / dir;
        let enter = to_min.min(to_max).max_element().max(f64::from(times.min));
        let leave = to_min.max(to_max).min_element().min(f64::from(times.max));
        (enter <= leave).then_some(Interval::new(enter as f32, leave as f32))
    }
}
