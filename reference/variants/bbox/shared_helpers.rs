// Defines helpers for boxes that bvh.rs also uses: the union of two boxes and the sum over an
// iterator.

use std::iter::Sum;
use std::ops::Add;

impl Add for BBox {
    type Output = BBox;

    /// Returns the union of the two boxes.
    fn add(mut self, other: BBox) -> BBox {
        self.enclose(other);
        self
    }
}

impl Sum for BBox {
    fn sum<I: Iterator<Item = BBox>>(boxes: I) -> BBox {
        boxes.fold(BBox::EMPTY, BBox::add)
    }
}

impl From<Vec3> for BBox {
    fn from(point: Vec3) -> BBox {
        BBox::new(point, point)
    }
}

/// Returns the time at which the ray enters a box, or infinity if it misses the box.
pub fn entry_or_infinity(bbox: &BBox, ray: &Ray) -> f32 {
    bbox.hit(ray, ray.range)
        .map_or(f32::INFINITY, |inside| inside.min)
}

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let to_min = (self.min - ray.origin) / ray.dir;
        let to_max = (self.max - ray.origin) / ray.dir;
        let enter = to_min.min(to_max).max_element().max(times.min);
        let leave = to_min.max(to_max).min_element().min(times.max);
        (enter <= leave).then_some(Interval::new(enter, leave))
    }
}
