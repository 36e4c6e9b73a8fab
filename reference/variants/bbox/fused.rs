// Computes each time with one fused multiply-add: plane · inverse − origin · inverse. A component
// of the direction that is almost 0 is replaced, so that its inverse is finite. See Wald, Woop,
// Benthin, Johnson and Ernst, "Embree: A Kernel Framework for Efficient CPU Ray Tracing", ACM TOG
// 33(4), 2014.

/// The minimum absolute value of each component of the direction.
const LEAST: Vec3 = Vec3::splat(1e-18);

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let inverse = Vec3::select(ray.dir.abs().cmplt(LEAST), LEAST, ray.dir).recip();
        let shift = -ray.origin * inverse;
        let to_min = self.min.mul_add(inverse, shift);
        let to_max = self.max.mul_add(inverse, shift);
        let enter = to_min.min(to_max).max_element().max(times.min);
        let leave = to_min.max(to_max).min_element().min(times.max);
        (enter <= leave).then_some(Interval::new(enter, leave))
    }
}
