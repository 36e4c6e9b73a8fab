//! The reference's bounding box, instrumented to count every intersection test. It has only the
//! methods that the reference's other files call.

use glam::Vec3;
use protocol::{Interval, Ray};

use crate::count;

#[path = "../../../src/bbox.rs"]
#[allow(dead_code, unused_imports, reason = "its tests are not run here")]
mod plain;

/// A box that counts its tests; see the reference's `BBox`.
#[derive(Clone, Copy, Debug)]
pub struct BBox {
    pub min: Vec3,
    pub max: Vec3,
}

impl BBox {
    pub const EMPTY: BBox = BBox {
        min: plain::BBox::EMPTY.min,
        max: plain::BBox::EMPTY.max,
    };

    pub fn new(min: Vec3, max: Vec3) -> Self {
        BBox { min, max }
    }

    pub fn enclose(&mut self, other: BBox) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    pub fn enclose_point(&mut self, point: Vec3) {
        self.enclose(BBox::new(point, point));
    }

    pub fn center(&self) -> Vec3 {
        self.plain().center()
    }

    pub fn surface_area(&self) -> f32 {
        self.plain().surface_area()
    }

    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        count::count_box();
        self.plain().hit(ray, times)
    }

    fn plain(&self) -> plain::BBox {
        plain::BBox::new(self.min, self.max)
    }
}
