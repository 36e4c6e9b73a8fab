// Folds over the axes, with one multiplication and one addition per plane: (plane − origin) ·
// inverse = plane · inverse − origin · inverse. The products are computed in double precision to
// avoid cancellation.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let inverse = ray.dir.as_dvec3().recip();
        let shift = -ray.origin.as_dvec3() * inverse;
        (0..3).try_fold(times, |inside, axis| {
            if ray.dir[axis] == 0.0 {
                // If the ray is parallel to the slab, the formula would be ∞ − ∞.
                let slab = self.min[axis]..=self.max[axis];
                return slab.contains(&ray.origin[axis]).then_some(inside);
            }
            let time = |plane: f32| (f64::from(plane) * inverse[axis] + shift[axis]) as f32;
            let (a, b) = (time(self.min[axis]), time(self.max[axis]));
            let inside = Interval::new(inside.min.max(a.min(b)), inside.max.min(a.max(b)));
            (inside.min <= inside.max).then_some(inside)
        })
    }
}
