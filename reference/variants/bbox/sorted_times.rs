// Sorts two lists: the times when the ray enters the slabs, together with the start of `times`, and
// the times when it leaves the slabs, together with the end of `times`. The result is the interval
// from the last entry to the first exit.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let (mut entries, mut exits) = (vec![times.min], vec![times.max]);
        for axis in 0..3 {
            let mut crossings = [self.min, self.max]
                .map(|corner| (corner[axis] - ray.origin[axis]) / ray.dir[axis]);
            crossings.sort_by(f32::total_cmp);
            entries.push(crossings[0]);
            exits.push(crossings[1]);
        }
        entries.sort_by(f32::total_cmp);
        exits.sort_by(f32::total_cmp);
        let inside = Interval::new(*entries.last()?, *exits.first()?);
        (inside.min <= inside.max).then_some(inside)
    }
}
