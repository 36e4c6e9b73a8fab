//! Boxes around shapes, to place the camera. Not for intersections.

use glam::Vec3;
use protocol::Shape;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lower corner.
    pub min: Vec3,
    /// The upper corner.
    pub max: Vec3,
}

impl Bounds {
    /// Returns the box around points. Without points, returns a box of size one around the origin.
    pub fn of_points(points: impl Iterator<Item = Vec3>) -> Self {
        let corners = points.filter(|point| point.is_finite()).map(|p| (p, p));
        let both = corners.reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
        let (min, max) = both.unwrap_or((Vec3::splat(-0.5), Vec3::splat(0.5)));
        Bounds { min, max }
    }

    /// Returns the box around shapes.
    pub fn of_shapes(shapes: &[Shape]) -> Self {
        Bounds::of_points(shapes.iter().flat_map(corners))
    }

    /// Returns the centre.
    pub fn center(&self) -> Vec3 {
        self.min.midpoint(self.max)
    }

    /// Returns the length of the diagonal.
    pub fn diagonal(&self) -> f32 {
        self.min.distance(self.max)
    }
}

/// Returns points whose box is the box of the shape.
pub fn corners(shape: &Shape) -> Vec<Vec3> {
    match *shape {
        Shape::Triangle { vertices, .. } => vertices.map(|vertex| vertex.position).to_vec(),
        Shape::FlatTriangle { corners, .. } => corners.to_vec(),
        Shape::Sphere { center, radius, .. } => vec![center - radius, center + radius],
    }
}
