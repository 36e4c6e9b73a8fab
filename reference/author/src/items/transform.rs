//! Moves a question elsewhere in space and changes its size. This catches code that depends on
//! absolute sizes or on being near the origin, since such code is correct in some places and wrong
//! in others.

use std::borrow::Cow;

use glam::{DVec3, Vec3};
use judging::exam::{ExamQuestion, Key};
use protocol::light::lights::{FlatLight, ListedLight, SphericalLight};
use protocol::{Interval, Question, Ray, Shape, TreeNode, Value};

use crate::oracle::bbox::Bounds;
use crate::oracle::scan;
use crate::seed::Rng;

/// A scale and an offset. Questions are first generated near the origin, with sizes of about one,
/// and then transformed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform {
    scale: f64,
    offset: DVec3,
}

impl Transform {
    /// Returns a transform that moves shapes far from the origin without scaling them. All
    /// coordinates along an axis share a sign.
    pub(super) fn elsewhere(rng: &mut Rng) -> Self {
        let mut far = || rng.sign() * rng.uniform(60.0, 120.0);
        Transform {
            scale: 1.0,
            offset: DVec3::new(far(), far(), far()),
        }
    }

    /// Returns the transform that scales shapes by this factor and then moves them.
    pub(super) fn new(scale: f64, offset: DVec3) -> Self {
        Transform { scale, offset }
    }

    /// Returns the transform that centres the box around these shapes at `center` and scales its
    /// longest side to twice `size`.
    pub(super) fn around(shapes: &[Shape], size: f64, center: DVec3) -> Self {
        let bounds = Bounds::enclosing(shapes.iter().map(scan::bounds));
        if bounds.half_side() <= 0.0 || shapes.is_empty() {
            return Transform {
                scale: size,
                offset: center,
            };
        }
        let scale = size / bounds.half_side();
        Transform {
            scale,
            offset: center - scale * bounds.center(),
        }
    }

    /// Returns a similar transform that keeps multiples of 1/128 exact: the factor is a power of
    /// two, and the offset is a multiple of 1/128 of the factor.
    pub(super) fn exact(self) -> Self {
        let scale = self.scale.log2().floor().exp2();
        let step = scale / 128.0;
        Transform {
            scale,
            offset: (self.offset / step).round() * step,
        }
    }

    /// Returns whether transformed coordinates are precise enough for the smallest of these shapes.
    pub(super) fn keeps_digits(self, shapes: &[Shape]) -> bool {
        /// The largest coordinate, as a multiple of the smallest shape's size.
        const MOST: f64 = 8000.0;
        let sides = shapes.iter().map(|shape| scan::bounds(shape).half_side());
        let smallest = sides
            .filter(|side| *side > 0.0)
            .fold(f64::INFINITY, f64::min);
        let largest = self.offset.abs().max_element();
        largest <= MOST * self.scale * smallest
    }

    /// Transforms a point.
    pub(super) fn point(self, point: Vec3) -> Vec3 {
        (point.as_dvec3() * self.scale + self.offset).as_vec3()
    }

    /// Scales a length.
    pub(super) fn length(self, length: f32) -> f32 {
        (f64::from(length) * self.scale) as f32
    }

    /// Transforms a shape.
    pub(super) fn shape(self, shape: &Shape) -> Shape {
        let mut shape = *shape;
        match &mut shape {
            Shape::Triangle { vertices, .. } => {
                for vertex in vertices {
                    vertex.position = self.point(vertex.position);
                }
            }
            Shape::FlatTriangle { corners, .. } => {
                *corners = corners.map(|corner| self.point(corner));
            }
            Shape::Sphere { center, radius, .. } => {
                *center = self.point(*center);
                *radius = self.length(*radius);
            }
        }
        shape
    }

    /// Transforms all shapes.
    pub(super) fn shapes(self, shapes: &[Shape]) -> Vec<Shape> {
        shapes.iter().map(|shape| self.shape(shape)).collect()
    }

    /// Transforms a ray.
    pub(super) fn ray(self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point(ray.origin),
            range: self.interval(ray.range),
            ..*ray
        }
    }

    /// Scales times along a ray.
    pub(super) fn interval(self, times: Interval) -> Interval {
        Interval::new(self.length(times.min), self.length(times.max))
    }

    /// Transforms a node. A sphere's centre and its box are rounded separately, so the box grows by
    /// two units in the last place to make sure that it still contains the sphere. A flat box stays
    /// flat.
    pub(super) fn node(self, node: &TreeNode) -> TreeNode {
        let (mut min, mut max) = (self.point(node.min), self.point(node.max));
        for axis in 0..3 {
            if self.offset != DVec3::ZERO && min[axis] < max[axis] {
                min[axis] = min[axis].next_down().next_down();
                max[axis] = max[axis].next_up().next_up();
            }
        }
        TreeNode { min, max, ..*node }
    }

    fn light(self, light: &ListedLight) -> ListedLight {
        match light {
            ListedLight::Flat(light) => ListedLight::Flat(self.flat_light(light)),
            ListedLight::Sphere(light) => ListedLight::Sphere(SphericalLight {
                center: self.point(light.center),
                radius: self.length(light.radius),
                ..*light
            }),
        }
    }

    fn flat_light(self, light: &FlatLight) -> FlatLight {
        let FlatLight {
            corner,
            edges: [first, second],
            ..
        } = *light;
        let corners = [corner, corner + first, corner + second].map(|point| self.point(point));
        FlatLight {
            corner: corners[0],
            edges: [corners[1] - corners[0], corners[2] - corners[0]],
            ..*light
        }
    }

    /// Transforms the value of a field. Values without a position or a size stay unchanged.
    fn value(self, value: Value<'_>) -> Value<'static> {
        match value {
            Value::Length(length) => Value::Length(self.length(length)),
            Value::Point(point) => Value::Point(self.point(point)),
            Value::Interval(times) => Value::Interval(self.interval(times)),
            Value::Range(range) => Value::Range(self.interval(range)),
            Value::Shapes(shapes) => Value::Shapes(self.shapes(&shapes).into()),
            Value::Nodes(nodes) => {
                let nodes: Vec<TreeNode> = nodes.iter().map(|node| self.node(node)).collect();
                Value::Nodes(nodes.into())
            }
            Value::Direction(direction) => Value::Direction(direction),
            Value::Uv(uv) => Value::Uv(uv),
            Value::Index(index) => Value::Index(index),
            Value::Count(count) => Value::Count(count),
            Value::Angle(angle) => Value::Angle(angle),
            Value::Ratio(ratio) => Value::Ratio(ratio),
            Value::Film(film) => Value::Film(film),
            Value::Pixel(pixel) => Value::Pixel(pixel),
            Value::Offset(offset) => Value::Offset(offset),
            Value::Color(color) => Value::Color(color),
            Value::Density(density) => Value::Density(density),
            Value::OptionalDensity(density) => Value::OptionalDensity(density),
            Value::Fraction(fraction) => Value::Fraction(fraction),
            Value::Random(random) => Value::Random(random),
            Value::RandomPair(random) => Value::RandomPair(random),
            Value::Lights(lights) => {
                let lights: Vec<ListedLight> = lights.iter().map(|it| self.light(it)).collect();
                Value::Lights(lights.into())
            }
            Value::Scene(room) => Value::Scene(Cow::Owned(room.into_owned())),
            Value::Map(map) => Value::Map(Cow::Owned(map.into_owned())),
        }
    }
}

/// Returns a transformed question, or `None` if it is about a picture or a scene file.
pub(super) fn moved(transform: Transform, asked: &ExamQuestion) -> Option<ExamQuestion> {
    let change = |value: Value<'_>| transform.value(value);
    let question = match (&asked.question, asked.question.table()) {
        (_, Some(table)) => {
            let mut values = table.subject().values();
            if values.any(|value| matches!(value, Value::Scene(_))) {
                return None;
            }
            table.changed(&change)?
        }
        (
            Question::Build {
                shapes,
                max_leaf_size,
            },
            None,
        ) => Question::Build {
            shapes: transform.shapes(shapes),
            max_leaf_size: *max_leaf_size,
        },
        (_, None) => return None,
    };
    let key = match &asked.key {
        Key::Table {
            judged,
            rows,
            aggregate,
        } => Key::Table {
            judged: judged.clone(),
            rows: rows.changed(&change),
            aggregate: *aggregate,
        },
        // A tree's cost is a ratio of areas.
        Key::Tree { .. } => asked.key.clone(),
        Key::FirstHits { .. } | Key::Radiance { .. } | Key::SpreadEvenly { .. } => return None,
    };
    Some(ExamQuestion::new(question, key))
}
