//! Calls whose shape differs from the previous call's shape in a single property.

use glam::{DVec3, Vec3};
use protocol::{Ray, Shape};

use super::ShapeCall;
use crate::domains::Call;
use crate::oracle::scan;

impl ShapeCall {
    /// Returns the call with a smaller shape around the same centre.
    pub fn smaller(&self, _: DVec3) -> Self {
        self.scaled(0.75)
    }

    /// Returns the call with a shape that is less than 1% larger, around the same centre.
    pub fn slightly_larger(&self, random: DVec3) -> Self {
        self.scaled(1.0 + (0.005 + 0.004 * random.x) as f32)
    }

    /// Returns the call with everything scaled by one half around the world's origin, except for
    /// the ray's range.
    pub fn in_a_smaller_world(&self, _: DVec3) -> Self {
        const HALF: f32 = 0.5;
        let shape = match moved(&self.shape, |point| HALF * point) {
            Shape::Sphere {
                center,
                radius,
                shape,
            } => Shape::Sphere {
                center,
                radius: HALF * radius,
                shape,
            },
            triangle @ (Shape::Triangle { .. } | Shape::FlatTriangle { .. }) => triangle,
        };
        let origin = HALF * self.ray.origin;
        ShapeCall::new(shape, Ray { origin, ..self.ray })
    }

    fn scaled(&self, factor: f32) -> Self {
        let middle = scan::bounds(&self.shape).center().as_vec3();
        let scaled = |point: Vec3| middle + factor * (point - middle);
        let mut call = ShapeCall::new(self.shape, self.ray);
        match &mut call.shape {
            Shape::Sphere { radius, .. } => *radius *= factor,
            triangle @ (Shape::Triangle { .. } | Shape::FlatTriangle { .. }) => {
                *triangle = moved(triangle, scaled);
            }
        }
        call
    }

    /// Returns the call with everything moved so that this point of the shape is at the origin.
    pub fn moved_to_origin(&self, point: Vec3) -> Self {
        let shape = moved(&self.shape, |corner| corner - point);
        let origin = self.ray.origin - point;
        ShapeCall::new(shape, Ray { origin, ..self.ray })
    }

    /// Returns the call with the shape moved along an axis by less than its size.
    pub fn elsewhere_along(&self, axis: usize, random: DVec3) -> Self {
        let offset = self.offset_along(axis, random);
        ShapeCall::new(moved(&self.shape, |point| point + offset), self.ray)
    }

    /// Returns the call with a shape that differs only in its number.
    pub fn with_other_number(&self, random: DVec3) -> Self {
        let mut call = ShapeCall::new(self.shape, self.ray);
        let (Shape::Sphere { shape, .. }
        | Shape::Triangle { shape, .. }
        | Shape::FlatTriangle { shape, .. }) = &mut call.shape;
        // Any bit of the number can be flipped.
        *shape ^= 1 << ((0.5 + 0.499 * random.x) * 32.0) as u32;
        call
    }

    /// Returns a vector along an axis that is either short or long compared to the shape's size.
    pub fn offset_along(&self, axis: usize, random: DVec3) -> Vec3 {
        let part = if random[(axis + 1) % 3] > 0.0 {
            0.5
        } else {
            0.02
        };
        (part * self.size() * random * DVec3::AXES[axis]).as_vec3()
    }
}

/// Returns the shape with its centre or its corners moved.
fn moved(shape: &Shape, to: impl Fn(Vec3) -> Vec3) -> Shape {
    let mut shape = *shape;
    match &mut shape {
        Shape::Sphere { center, .. } => *center = to(*center),
        Shape::Triangle { vertices, .. } => {
            for vertex in vertices {
                vertex.position = to(vertex.position);
            }
        }
        Shape::FlatTriangle { corners, .. } => *corners = corners.map(to),
    }
    shape
}
