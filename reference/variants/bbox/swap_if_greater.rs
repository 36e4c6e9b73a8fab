// Goes through the axes one by one, swaps the two times if they are in the wrong order, and
// returns at the first axis that leaves an empty interval. See Shirley, Black and Hollasch, "Ray
// Tracing: The Next Week", "Ray Intersection with an AABB".

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let mut inside = times;
        for axis in 0..3 {
            let inverse = 1.0 / ray.dir[axis];
            let mut enter = (self.min[axis] - ray.origin[axis]) * inverse;
            let mut leave = (self.max[axis] - ray.origin[axis]) * inverse;
            if enter > leave {
                std::mem::swap(&mut enter, &mut leave);
            }

            inside.min = inside.min.max(enter);
            inside.max = inside.max.min(leave);
            if inside.min > inside.max {
                return None;
            }
        }
        Some(inside)
    }
}
