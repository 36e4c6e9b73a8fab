// Clips the ray by the method of Liang and Barsky, "A New Concept and Method for Line Clipping",
// ACM Transactions on Graphics 3(1), 1984: each of six inequalities p·t ≤ q limits one end of the
// interval.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let Interval { mut min, mut max } = times;
        let to_min = ray.origin - self.min;
        let to_max = self.max - ray.origin;
        let inequalities = (0..3).flat_map(|axis| {
            [
                (-ray.dir[axis], to_min[axis]),
                (ray.dir[axis], to_max[axis]),
            ]
        });
        for (p, q) in inequalities {
            if p == 0.0 {
                if q < 0.0 {
                    return None;
                }
            } else if p < 0.0 {
                // The ray enters through this plane.
                min = min.max(q / p);
            } else {
                max = max.min(q / p);
            }
            if min > max {
                return None;
            }
        }
        Some(Interval::new(min, max))
    }
}
