// Defines a type for sets of times with the operator & for intersections.

use std::ops::BitAnd;

#[derive(Clone, Copy)]
struct Times(Interval);

impl BitAnd for Times {
    type Output = Times;

    fn bitand(self, other: Times) -> Times {
        Times(Interval::new(
            self.0.min.max(other.0.min),
            self.0.max.min(other.0.max),
        ))
    }
}

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let slabs = [0, 1, 2].map(|axis| {
            let times = [self.min, self.max].map(|corner| corner[axis] - ray.origin[axis]);
            let [a, b] = times.map(|distance| distance / ray.dir[axis]);
            Times(Interval::new(a.min(b), a.max(b)))
        });
        let Times(inside) = slabs.into_iter().fold(Times(times), Times::bitand);
        (!inside.is_empty()).then_some(inside)
    }
}
