//! Calls to `hit` on a single shape, and the aspects that all shapes have in common.

mod changes;
mod history;

use glam::Vec3;
use protocol::{Geometry, Question, Ray, Shape};

use super::fields::{self, DISTANCES, NUMBERS, distance_class, number_class};
use super::{Aimed, Aspect, Call, Placed};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::seed::Rng;

pub use history::FOLLOW;

/// A call to `hit`: a shape and a ray.
#[derive(Clone, Copy, Debug)]
pub struct ShapeCall {
    /// The shape.
    pub shape: Shape,
    /// The ray.
    pub ray: Ray,
    /// The ray from the previous call, if that call was on the same shape.
    pub before: Option<Ray>,
}

impl ShapeCall {
    /// Returns the hit, or `None` if the ray misses.
    pub fn hit(&self) -> Option<Intersection> {
        scan::intersect(&Ray64::from(&self.ray), &self.shape)
    }

    /// Returns the distance of the hit, or `None` if the ray misses.
    pub fn distance(&self) -> Option<f64> {
        scan::hit_distance(&Ray64::from(&self.ray), &self.shape)
    }

    /// Returns whether the answers to the two calls differ in a judged quantity by more than twice
    /// its tolerance.
    pub fn differs(&self, other: &Self, judged: &[&str]) -> bool {
        let (Some(hit), Some(other_hit)) = (self.hit(), other.hit()) else {
            return self.is_hit() != other.is_hit();
        };
        let coordinates = |call: &ShapeCall| {
            let Bounds { min, max } = scan::bounds(&call.shape);
            let corners = min.abs().max(max.abs());
            corners.max(call.ray.origin.as_dvec3().abs()).max_element()
        };
        let scale = coordinates(self).max(coordinates(other));
        let scale = scale.max(hit.distance).max(other_hit.distance);
        judged.iter().any(|&quantity| match quantity {
            "distance" => (hit.distance - other_hit.distance).abs() > 2e-4 * scale,
            "position" => hit.position.distance(other_hit.position) > 2e-4 * scale,
            "normal" => hit.normal.distance(other_hit.normal) > 2e-3,
            "uv" => hit.uv.distance(other_hit.uv) > 4e-3,
            "origin" => self.ray.origin != other.ray.origin,
            "shape" => hit.shape != other_hit.shape,
            _ => false,
        })
    }

    /// Returns half of the longest side of the shape's box.
    pub fn size(&self) -> f64 {
        scan::bounds(&self.shape).half_side()
    }
}

impl Aimed for ShapeCall {
    fn ray(&self) -> &Ray {
        &self.ray
    }
}

impl Placed for ShapeCall {
    fn bounds(&self) -> Option<Bounds> {
        Some(scan::bounds(&self.shape))
    }
}

/// The number of the shape.
pub const NUMBER: Aspect<ShapeCall> = Aspect::new("number", NUMBERS, |call| {
    Some(number_class(call.shape.number()))
});

/// Rays that start at the origin, like those of a camera, or on an axis.
pub const ORIGIN: Aspect<ShapeCall> = Aspect::new(
    "ray",
    &["from the origin", "from an axis", "from between two axes"],
    |call| match call.ray.origin.cmpeq(Vec3::ZERO).bitmask().count_ones() {
        3 => Some(0),
        2 => Some(1),
        1 => Some(2),
        _ => None,
    },
);

/// The distance of the hit.
pub const DISTANCE: Aspect<ShapeCall> = Aspect::new("distance", DISTANCES, |call| {
    Some(distance_class(call.distance()?))
});

/// The class of a call whose direction is virtually the previous call's.
pub const HARDLY_TURNED: &str = "virtually the same direction";

/// The class of a call whose start is virtually the previous call's.
pub const HARDLY_MOVED: &str = "virtually the same start";

/// The class of a call whose start is a mirror image of the previous call's.
pub const MIRRORED_START: &str = "a mirrored start";

/// The previous call.
pub const HISTORY: Aspect<ShapeCall> = Aspect::new(
    "call before",
    &[
        "none",
        "another ray",
        "the same ray with another range",
        "the same ray with almost the same range",
        "almost the same direction",
        "almost the same start",
        "the opposite direction",
        "the same ray with its axes in another order",
        "a ray that hits almost where this ray starts",
        "a mirrored direction",
        HARDLY_TURNED,
        HARDLY_MOVED,
        MIRRORED_START,
    ],
    |call| Some(history::class_of(call)),
);

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
        self.distance().is_some()
    }

    fn with_other_range(&self, rng: &mut Rng) -> Option<Self> {
        let distance = self.distance()?;
        let range = fields::range(rng, distance + 2.0 * self.size());
        let ray = self.ray.within(range.min, range.max);
        Some(ShapeCall { ray, ..*self })
    }
}

/// Returns the calls in a question about a single shape.
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
