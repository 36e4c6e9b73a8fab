use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vertex {
    /// Where it is.
    pub position: Vec3,
    /// The surface normal there, of length one; need not be the face's normal.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
}

impl Vertex {
    /// A vertex from its three parts.
    pub const fn new(position: Vec3, normal: Vec3, uv: Vec2) -> Self {
        Vertex {
            position,
            normal,
            uv,
        }
    }
}
