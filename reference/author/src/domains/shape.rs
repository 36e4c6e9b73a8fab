//! Calls of `hit` of a single shape, and what all shapes have in common.

use glam::Vec3;
use protocol::{Geometry, Question, Ray, Shape};

use super::fields::{
    self, DIRECTIONS, DISTANCES, NUMBERS, RANGES, direction_class, distance_class, history_class,
    number_class, range_class,
};
use super::{Aspect, Call, Placed};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// A call of `hit`: a shape and a ray.
#[derive(Clone, Copy, Debug)]
pub struct ShapeCall {
    /// The shape.
    pub shape: Shape,
    /// The ray.
    pub ray: Ray,
    /// The ray of the call before this one, if it was about the same shape.
    pub before: Option<Ray>,
}

impl ShapeCall {
    /// Returns the call of a smaller shape with the same centre.
    pub fn smaller(&self) -> Self {
        const FACTOR: f32 = 0.75;
        let middle = scan::bounds(&self.shape).center().as_vec3();
        let scaled = |point: Vec3| middle + FACTOR * (point - middle);
        let mut call = ShapeCall::new(moved(&self.shape, scaled), self.ray);
        if let Shape::Sphere { radius, .. } = &mut call.shape {
            *radius *= FACTOR;
        }
        call
    }

    /// Returns the call with everything moved, so that this point of the shape is the origin.
    pub fn moved_to_origin(&self, point: Vec3) -> Self {
        let shape = moved(&self.shape, |corner| corner - point);
        let origin = self.ray.origin - point;
        ShapeCall::new(shape, Ray { origin, ..self.ray })
    }

    /// Returns the call of a shape that differs in its number only.
    pub fn with_other_number(&self) -> Self {
        let mut call = ShapeCall::new(self.shape, self.ray);
        let (Shape::Sphere { shape, .. }
        | Shape::Triangle { shape, .. }
        | Shape::FlatTriangle { shape, .. }) = &mut call.shape;
        *shape ^= 1;
        call
    }

    /// Returns half of the largest side of the shape's box.
    pub fn size(&self) -> f64 {
        scan::bounds(&self.shape).half_side()
    }
}

impl Placed for ShapeCall {
    fn bounds(&self) -> Option<Bounds> {
        Some(scan::bounds(&self.shape))
    }
}

/// The number of the shape.
pub const NUMBER: Aspect<ShapeCall> = Aspect {
    name: "number",
    classes: NUMBERS,
    class: |call| Some(number_class(call.shape.number())),
};

/// The direction of the ray.
pub const DIRECTION: Aspect<ShapeCall> = Aspect {
    name: "direction",
    classes: DIRECTIONS,
    class: |call| direction_class(call.ray.dir),
};

/// The distance of the hit.
pub const DISTANCE: Aspect<ShapeCall> = Aspect {
    name: "distance",
    classes: DISTANCES,
    class: |call| {
        let hit = scan::intersect(&Ray64::from(&call.ray), &call.shape)?;
        Some(distance_class(hit.distance))
    },
};

/// The range of the ray.
pub const RANGE: Aspect<ShapeCall> = Aspect {
    name: "range",
    classes: RANGES,
    class: |call| range_class(call.ray.range),
};

/// The call before.
pub const HISTORY: Aspect<ShapeCall> = Aspect {
    name: "call before",
    classes: &["none", "another ray", "the same ray with another range"],
    class: |call| Some(history_class(call.before.as_ref(), &call.ray)),
};

/// Returns a shape with its centre or its corners moved.
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

impl Call for ShapeCall {
    type Subject = Shape;
    type Input = Ray;

    fn new(shape: Shape, ray: Ray) -> Self {
        ShapeCall {
            shape,
            ray,
            before: None,
        }
    }

    fn subject(&self) -> Shape {
        self.shape
    }

    fn input(&self) -> Ray {
        self.ray
    }

    fn is_hit(&self) -> bool {
        scan::intersect(&Ray64::from(&self.ray), &self.shape).is_some()
    }

    fn with_other_range(&self, rng: &mut Rng) -> Option<Self> {
        let distance = scan::intersect(&Ray64::from(&self.ray), &self.shape)?.distance;
        let range = fields::range(rng, distance + 2.0 * self.size());
        let ray = self.ray.within(range.min, range.max);
        Some(ShapeCall { ray, ..*self })
    }
}

/// Returns the calls of a question about a single shape.
pub fn calls(question: &Question) -> Vec<ShapeCall> {
    let Question::Hit(table) = question else {
        return Vec::new();
    };
    let Geometry::List { shapes } = &table.subject else {
        return Vec::new();
    };
    let [shape] = shapes[..] else {
        return Vec::new();
    };
    let rays = table.rows.to_vec();
    let before = std::iter::once(None).chain(rays.iter().copied().map(Some));
    let calls = rays.iter().zip(before);
    let calls = calls.map(|(&ray, before)| ShapeCall { shape, ray, before });
    calls.collect()
}
