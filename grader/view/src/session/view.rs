//! The quantities that can be shown.

use serde::{Deserialize, Serialize};

/// The quantity that the picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum View {
    /// The scene with its lighting.
    Shaded,
    /// The scene without materials, lit from the camera.
    Clay,
    /// Normals.
    Normals,
    /// Distances.
    Depth,
    /// Texture coordinates.
    Uv,
    /// Boxes around the hit.
    Bvh,
    /// Numbers of tests.
    Tests,
}

impl View {
    /// Returns the index of the layer that the view shows.
    pub(super) fn layer(self) -> usize {
        match self {
            View::Shaded => 0,
            View::Clay | View::Normals | View::Depth | View::Uv | View::Bvh => 1,
            View::Tests => 2,
        }
    }
}
