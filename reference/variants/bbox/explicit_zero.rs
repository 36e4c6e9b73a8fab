// Handles zero components of the direction in a separate branch to avoid dividing by zero. Compares
// entry and exit only once, after the last axis.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let (mut enter, mut leave) = (times.min, times.max);
        for axis in 0..3 {
            let (origin, dir) = (ray.origin[axis], ray.dir[axis]);
            if dir == 0.0 {
                if origin < self.min[axis] || origin > self.max[axis] {
                    return None;
                }
                continue;
            }
            let to_min = (self.min[axis] - origin) / dir;
            let to_max = (self.max[axis] - origin) / dir;
            enter = enter.max(to_min.min(to_max));
            leave = leave.min(to_min.max(to_max));
        }
        (enter <= leave).then_some(Interval::new(enter, leave))
    }
}
