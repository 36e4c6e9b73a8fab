// Uses the signs of the inverse direction to select the corners at which the ray enters and leaves
// the slabs, for all axes at once.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let inverse = 1.0 / ray.dir;
        let backward = inverse.cmplt(Vec3::ZERO);
        let near = Vec3::select(backward, self.max, self.min);
        let far = Vec3::select(backward, self.min, self.max);

        let enter = (near - ray.origin) * inverse;
        let leave = (far - ray.origin) * inverse;
        let min = enter.max_element().max(times.min);
        let max = leave.min_element().min(times.max);
        (min <= max).then_some(Interval::new(min, max))
    }
}
