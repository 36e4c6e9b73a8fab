// Computes the interval of times that the ray spends in each slab and intersects `times` with each
// of these intervals. Returns early with `?` if an intersection is empty.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let inside = overlap(times, self.slab(ray, 0))?;
        let inside = overlap(inside, self.slab(ray, 1))?;
        overlap(inside, self.slab(ray, 2))
    }

    /// Returns the times during which the ray is between the two planes perpendicular to `axis`.
    fn slab(&self, ray: &Ray, axis: usize) -> Interval {
        let time = |plane: f32| (plane - ray.origin[axis]) / ray.dir[axis];
        let (a, b) = (time(self.min[axis]), time(self.max[axis]));
        if a < b {
            Interval::new(a, b)
        } else {
            Interval::new(b, a)
        }
    }
}

fn overlap(a: Interval, b: Interval) -> Option<Interval> {
    let both = Interval::new(a.min.max(b.min), a.max.min(b.max));
    (!both.is_empty()).then_some(both)
}
