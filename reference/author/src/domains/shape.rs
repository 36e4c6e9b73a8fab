//! Calls of `hit` of a single shape, and what all shapes have in common.

use std::ops::Range;

use glam::DVec3;
use protocol::{Geometry, Question, Ray, Shape};

use super::fields::{
    DIRECTIONS, NUMBERS, OCTANTS, PLACES, RANGES, SIZES, direction_class, number_class, octant,
    place_class, range_class, size_class,
};
use super::{Aspect, Balance, Domain};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// A call of `hit`: a shape and a ray.
#[derive(Clone, Copy, Debug)]
pub struct ShapeCall {
    /// The shape.
    pub shape: Shape,
    /// The ray.
    pub ray: Ray,
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

/// The range of the ray.
pub const RANGE: Aspect<ShapeCall> = Aspect {
    name: "range",
    classes: RANGES,
    class: |call| range_class(call.ray.range),
};

/// The domain of `hit` of one kind of shape.
#[derive(Debug)]
pub struct ShapeDomain {
    /// The name of the method.
    pub function: &'static str,
    /// How its calls differ.
    pub aspects: &'static [Aspect<ShapeCall>],
}

impl Domain for ShapeDomain {
    fn function(&self) -> &'static str {
        self.function
    }

    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])> {
        let aspects = self.aspects.iter();
        aspects
            .map(|aspect| (aspect.name, aspect.classes))
            .collect()
    }

    fn classes(&self, question: &Question) -> Vec<Vec<Option<usize>>> {
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
        let calls = rays.iter().map(|&ray| ShapeCall { shape, ray });
        let classes = calls.map(|call| {
            let aspects = self.aspects.iter();
            aspects.map(|aspect| (aspect.class)(&call)).collect()
        });
        classes.collect()
    }
}

/// Draws a shape of each of these sizes, each with rays of which every other one is a hit, so that each
/// class of each aspect occurs.
pub fn tables(
    rng: &mut Rng,
    aspects: &'static [Aspect<ShapeCall>],
    sizes: Range<usize>,
    shape: impl Fn(&mut Rng, usize) -> Shape,
    call: impl Fn(&mut Rng, &Shape) -> Option<ShapeCall>,
) -> Vec<(Shape, Vec<Ray>)> {
    const ROWS: usize = 14;
    let mut balance = Balance::new(aspects);
    let table = |size: usize| {
        rng.retry(|rng| {
            let shape = balance.clone().choose(rng, |rng| {
                let shape = shape(rng, size);
                rng.attempt(100, |rng| call(rng, &shape))
            })?;
            let shape = shape.shape;
            let mut drawn = balance.clone();
            let rays = (0..ROWS).map(|row| {
                let expected = row % 2 == 0;
                let chosen = drawn.choose(rng, |rng| {
                    let call = call(rng, &shape)?;
                    let hit = scan::intersect(&Ray64::from(&call.ray), &shape);
                    (hit.is_some() == expected).then_some(call)
                });
                Some(chosen?.ray)
            });
            let rays = rays.collect::<Option<Vec<Ray>>>()?;
            balance = drawn;
            Some((shape, rng.shuffled(rays)))
        })
    };
    sizes.map(table).collect()
}
