//! Calls of `hit` of a single shape, and what all shapes have in common.

use glam::DVec3;
use protocol::{Geometry, Question, Ray, Shape};

use super::fields::{
    self, DIRECTIONS, DISTANCES, NUMBERS, OCTANTS, PLACES, RANGES, SIZES, direction_class,
    distance_class, history_class, number_class, octant, place_class, range_class, size_class,
};
use super::{Aspect, Call};
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
    /// Returns half of the largest side of the shape's box.
    pub fn size(&self) -> f64 {
        let bounds = scan::bounds(&self.shape);
        0.5 * (bounds.max - bounds.min).max_element()
    }

    fn middle(&self) -> DVec3 {
        scan::bounds(&self.shape).center()
    }
}

/// The size of the shape.
pub const SIZE: Aspect<ShapeCall> = Aspect {
    name: "size",
    classes: SIZES,
    class: |call| Some(size_class(call.size())),
};

/// The position of the shape.
pub const PLACE: Aspect<ShapeCall> = Aspect {
    name: "place",
    classes: PLACES,
    class: |call| Some(place_class(call.middle(), call.size())),
};

/// The octant of the shape's position.
pub const OCTANT: Aspect<ShapeCall> = Aspect {
    name: "octant",
    classes: OCTANTS,
    class: |call| octant(call.middle()),
};

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

    fn other_subject(&self) -> Shape {
        const FACTOR: f32 = 0.75;
        let middle = self.middle().as_vec3();
        let mut shape = self.shape;
        match &mut shape {
            Shape::Sphere { radius, .. } => *radius *= FACTOR,
            Shape::Triangle { vertices, .. } => {
                for vertex in vertices {
                    vertex.position = middle + FACTOR * (vertex.position - middle);
                }
            }
            Shape::FlatTriangle { corners, .. } => {
                *corners = corners.map(|corner| middle + FACTOR * (corner - middle));
            }
        }
        shape
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
