use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::vertex::Vertex;

/// One primitive, as it is described to a submission, which makes its own type of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A triangle with a normal and texture coordinates at each corner.
    Triangle {
        /// The corners p0, p1, p2.
        vertices: [Vertex; 3],
        /// What its `Trace` shall name.
        material: u32,
    },
    /// A triangle given by its corners alone; see [`Shape::facet_vertices`].
    #[serde(alias = "facet")]
    FlatTriangle {
        /// The corners p0, p1, p2.
        corners: [Vec3; 3],
        /// What its `Trace` shall name.
        material: u32,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        center: Vec3,
        /// Its radius, above zero.
        radius: f32,
        /// What its `Trace` shall name.
        material: u32,
    },
}

impl Shape {
    /// The vertices of a [`Shape::Facet`]: the face's normal (of `(p1 - p0) × (p2 - p0)`, or zero
    /// where the corners are in line) and the texture coordinates (0, 0), (1, 0), (0, 1).
    pub fn flat_triangle_vertices(corners: [Vec3; 3]) -> [Vertex; 3] {
        let [p0, p1, p2] = corners;
        let normal = (p1 - p0).cross(p2 - p0).normalize_or_zero();
        [
            Vertex::new(p0, normal, Vec2::ZERO),
            Vertex::new(p1, normal, Vec2::X),
            Vertex::new(p2, normal, Vec2::Y),
        ]
    }

    /// Former name of [`Shape::flat_triangle_vertices`].
    #[doc(hidden)]
    pub fn facet_vertices(corners: [Vec3; 3]) -> [Vertex; 3] {
        Shape::flat_triangle_vertices(corners)
    }

    /// What its `Trace` shall name; in questions about trees, distinct for each primitive.
    pub fn material(&self) -> u32 {
        match *self {
            Shape::Triangle { material, .. }
            | Shape::FlatTriangle { material, .. }
            | Shape::Sphere { material, .. } => material,
        }
    }
}
