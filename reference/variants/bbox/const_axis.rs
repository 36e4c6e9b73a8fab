// Uses one method for the slabs of all axes. The axis is a const parameter.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let inside = self.clip_to_slab::<0>(ray, times)?;
        let inside = self.clip_to_slab::<1>(ray, inside)?;
        self.clip_to_slab::<2>(ray, inside)
    }

    /// Returns the part of `times` during which the ray is inside the slab of an axis.
    fn clip_to_slab<const AXIS: usize>(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let (min, max) = (self.min[AXIS], self.max[AXIS]);
        let (origin, inverse) = (ray.origin[AXIS], ray.dir[AXIS].recip());
        // Dividing by −0 gives −∞, so the sign of the inverse decides which plane comes first.
        let (near, far) = if inverse.is_sign_negative() {
            (max, min)
        } else {
            (min, max)
        };
        let enter = times.min.max((near - origin) * inverse);
        let leave = times.max.min((far - origin) * inverse);
        (enter <= leave).then_some(Interval::new(enter, leave))
    }
}
