use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vertex {
    /// The position of the corner.
    pub position: Vec3,
    /// The surface normal at this corner, of length one. It can differ from the face's normal.
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
