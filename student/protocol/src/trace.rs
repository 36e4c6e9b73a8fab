use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// A hit: the point where a ray intersects a surface, and the surface's properties there.
///
/// There is no flag for "no hit": a miss is the `None` of `Option<Trace>`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// The distance from the ray's origin to the hit, along the ray.
    pub distance: f32,
    /// The point of the hit.
    pub position: Vec3,
    /// The surface normal at that point.
    pub normal: Vec3,
    /// The texture coordinates at that point.
    pub uv: Vec2,
    /// The origin of the ray.
    pub origin: Vec3,
    /// The number of the shape that was hit.
    pub shape: u32,
}

impl Trace {
    /// Returns the nearer of two hits. A miss is farther away than any hit.
    pub fn nearer(a: Option<Trace>, b: Option<Trace>) -> Option<Trace> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
            (hit, None) | (None, hit) => hit,
        }
    }
}
