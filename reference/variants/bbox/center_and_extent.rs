// Uses the centre and half the size of the box: a ray crosses the middle of a slab exactly halfway
// between entering and leaving the slab. A ray parallel to the slab is a separate case, since it
// never crosses the middle.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let to_center = self.center() - ray.origin;
        let half = 0.5 * (self.max - self.min);
        let (mut enter, mut leave) = (times.min, times.max);
        for axis in 0..3 {
            let dir = ray.dir[axis];
            if dir != 0.0 {
                let middle = to_center[axis] / dir;
                let before_and_after = half[axis] / dir.abs();
                enter = enter.max(middle - before_and_after);
                leave = leave.min(middle + before_and_after);
            } else if to_center[axis].abs() > half[axis] {
                return None;
            }
        }
        (enter <= leave).then_some(Interval::new(enter, leave))
    }
}
