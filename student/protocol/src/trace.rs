use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// What is known of the place where a ray meets a surface.
///
/// There is no flag for "no hit": that is `None` of `Option<Trace>`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// From the ray's origin to the meeting, along the ray.
    pub distance: f32,
    /// The meeting itself.
    pub position: Vec3,
    /// The surface normal there.
    pub normal: Vec3,
    /// The surface's texture coordinates there.
    pub uv: Vec2,
    /// The origin of the ray that was asked.
    pub origin: Vec3,
    /// The material of the primitive that was met.
    pub material: u32,
}

impl Trace {
    /// The nearer of two answers; a miss is farther than any hit.
    pub fn nearer(a: Option<Trace>, b: Option<Trace>) -> Option<Trace> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
            (hit, None) | (None, hit) => hit,
        }
    }
}
