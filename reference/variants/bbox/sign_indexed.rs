// Uses the sign of the inverse direction to select the plane where the ray enters each slab. The
// sign of the direction itself would not be enough: −0 is not less than 0, but its inverse is −∞.
// See Williams, Barrus, Morley and Shirley, "An Efficient and Robust Ray-Box Intersection
// Algorithm", Journal of Graphics Tools 10(1), 2005.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let bounds = [self.min, self.max];
        let inverse = ray.dir.recip();
        let sign = inverse
            .to_array()
            .map(|component| usize::from(component < 0.0));
        let enter = |axis: usize| (bounds[sign[axis]][axis] - ray.origin[axis]) * inverse[axis];
        let leave = |axis: usize| (bounds[1 - sign[axis]][axis] - ray.origin[axis]) * inverse[axis];

        let (mut min, mut max) = (enter(0), leave(0));
        for axis in 1..3 {
            let (next_min, next_max) = (enter(axis), leave(axis));
            if min > next_max || next_min > max {
                return None;
            }
            min = min.max(next_min);
            max = max.min(next_max);
        }
        if min > times.max || max < times.min {
            return None;
        }
        Some(Interval::new(min.max(times.min), max.min(times.max)))
    }
}
