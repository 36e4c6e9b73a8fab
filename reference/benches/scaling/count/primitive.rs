//! The reference's primitive, which counts every test.

use protocol::{Ray, Shape, Trace};

use crate::bbox::BBox;
use crate::count;

#[path = "../../../src/primitive.rs"]
#[allow(dead_code, reason = "its material is not used here")]
mod plain;

/// A primitive that counts its tests; see the reference's `Primitive`.
#[derive(Clone, Copy, Debug)]
pub struct Primitive(plain::Primitive);

impl Primitive {
    pub fn new(shape: &Shape) -> Self {
        Primitive(plain::Primitive::new(shape))
    }

    pub fn bbox(&self) -> BBox {
        self.0.bbox()
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        count::count_primitive();
        self.0.hit(ray)
    }
}
