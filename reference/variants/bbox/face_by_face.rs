// Intersects the six faces, each a rectangle. The result is the interval from the earliest to the
// latest of these hits. An end of `times` counts as a hit if the ray is inside the box at that
// time.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let mut inside = Interval::new(f32::INFINITY, f32::NEG_INFINITY);
        let on_faces = (0..3).flat_map(|axis| self.on_faces(ray, axis));
        let on_faces = on_faces.flatten().filter(|time| times.contains(*time));
        let ends = [times.min, times.max];
        let ends = ends.into_iter().filter(|time| self.holds(ray, *time));
        for time in on_faces.chain(ends) {
            inside.min = inside.min.min(time);
            inside.max = inside.max.max(time);
        }
        (!inside.is_empty()).then_some(inside)
    }

    /// Returns the times at which the ray hits the two faces perpendicular to `axis`.
    fn on_faces(&self, ray: &Ray, axis: usize) -> [Option<f32>; 2] {
        [self.min, self.max].map(|corner| {
            let time = (corner[axis] - ray.origin[axis]) / ray.dir[axis];
            let mut point = ray.at(time);
            // Rounding may have moved the point off the plane.
            point[axis] = corner[axis];
            self.around(point).then_some(time)
        })
    }

    fn holds(&self, ray: &Ray, time: f32) -> bool {
        // At an infinite time, the ray is outside every box. Computing the point would give NaN for
        // 0 · ∞.
        time.is_finite() && self.around(ray.at(time))
    }

    fn around(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }
}
