use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vertex {
    /// The position of the corner.
    pub position: Vec3,
    /// The unit normal of the surface at this corner. It can differ from the face's normal.
    pub normal: Vec3,
    /// The texture coordinates.
    pub uv: Vec2,
}

impl Vertex {
    /// Creates a vertex.
    pub const fn new(position: Vec3, normal: Vec3, uv: Vec2) -> Self {
        Vertex {
            position,
            normal,
            uv,
        }
    }
}

/// A primitive as described to a submission, which converts it to its own type.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A triangle with a normal and texture coordinates at each corner.
    Triangle {
        /// The corners p0, p1, p2.
        vertices: [Vertex; 3],
        /// The number to report as `shape` in the `Trace`.
        shape: u32,
    },
    /// A triangle defined only by its corners. See [`Shape::flat_triangle_vertices`].
    FlatTriangle {
        /// The corners p0, p1, p2.
        corners: [Vec3; 3],
        /// The number to report as `shape` in the `Trace`.
        shape: u32,
    },
    /// A sphere, defined by its centre and radius.
    Sphere {
        /// The centre.
        center: Vec3,
        /// The radius, greater than zero.
        radius: f32,
        /// The number to report as `shape` in the `Trace`.
        shape: u32,
    },
}

impl Shape {
    /// Returns the vertices of a [`Shape::FlatTriangle`]. Each has the normal of the face, which is
    /// `(p1 - p0) × (p2 - p0)` normalised, or zero if the corners are collinear. The texture
    /// coordinates are (0, 0), (1, 0) and (0, 1).
    pub fn flat_triangle_vertices(corners: [Vec3; 3]) -> [Vertex; 3] {
        let [p0, p1, p2] = corners;
        let normal = (p1 - p0).cross(p2 - p0).normalize_or_zero();
        [
            Vertex::new(p0, normal, Vec2::ZERO),
            Vertex::new(p1, normal, Vec2::X),
            Vertex::new(p2, normal, Vec2::Y),
        ]
    }

    /// Returns the number to report as `shape` in the `Trace`. In questions about trees, each
    /// primitive has a different number.
    pub fn number(&self) -> u32 {
        match *self {
            Shape::Triangle { shape, .. }
            | Shape::FlatTriangle { shape, .. }
            | Shape::Sphere { shape, .. } => shape,
        }
    }
}
