//! Lists of shapes, which occur only in questions.

use protocol::Shape;

use super::point::largest_coordinate;
use super::{FieldType, number, point};

pub(super) struct Shapes<'a>(pub(super) &'a [Shape]);

impl FieldType for Shapes<'_> {
    fn text(&self) -> String {
        one_or_count(self.0)
    }

    fn largest_coordinate(&self) -> Option<f32> {
        Some(self.0.iter().map(of_shape).fold(0.0, f32::max))
    }
}

fn of_shape(shape: &Shape) -> f32 {
    match shape {
        Shape::Triangle { vertices, .. } => {
            let corners = vertices.iter();
            let corners = corners.map(|vertex| largest_coordinate(vertex.position));
            corners.fold(0.0, f32::max)
        }
        Shape::FlatTriangle { corners, .. } => {
            let corners = corners.iter();
            corners
                .map(|corner| largest_coordinate(*corner))
                .fold(0.0, f32::max)
        }
        Shape::Sphere { center, radius, .. } => largest_coordinate(*center) + radius,
    }
}

/// If there are only a few shapes, describes each in full. Otherwise, returns only their number.
pub fn text(shapes: &[Shape]) -> String {
    const FEW: usize = 6;
    if shapes.len() > FEW {
        return one_or_count(shapes);
    }
    let texts: Vec<String> = shapes.iter().map(shape_text).collect();
    texts.join("; ")
}

/// Describes a single shape in full. For several shapes, returns only their number.
pub fn one_or_count(shapes: &[Shape]) -> String {
    match shapes {
        [one] => shape_text(one),
        _ => format!("{} primitives", shapes.len()),
    }
}

fn shape_text(shape: &Shape) -> String {
    match *shape {
        Shape::Triangle { vertices, .. } => {
            let [p0, p1, p2] = vertices.map(|vertex| point(vertex.position));
            format!("triangle {p0} {p1} {p2}")
        }
        Shape::FlatTriangle { corners, .. } => {
            let [p0, p1, p2] = corners.map(point);
            format!("triangle {p0} {p1} {p2}")
        }
        Shape::Sphere { center, radius, .. } => {
            let (center, radius) = (point(center), number(radius));
            format!("sphere of radius {radius} around {center}")
        }
    }
}
