//! A scene as sent to a probe, which cannot read files.

use std::borrow::Cow;

use framework::render::renderer::PathSettings;
use framework::scene::{Camera, Scene};
use protocol::{Panic, Shape, Tree};
use serde::{Deserialize, Serialize};

use crate::messages::SubmissionPart;

/// A scene and the first camera to view it with.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneData {
    /// The scene.
    pub scene: Scene,
    /// The tree to traverse.
    pub tree: TreeSource,
    /// The first camera.
    pub aim: Aim,
    /// Whether the rays and tests are recorded.
    pub is_recorded: bool,
}

/// Returns the shapes that are drawn: those whose `hit` isn't among the missing parts.
pub fn written_shapes<'a>(
    shapes: &'a [Shape],
    missing: &[(SubmissionPart, Panic)],
) -> Cow<'a, [Shape]> {
    let has = |part| missing.iter().all(|(known, _)| *known != part);
    let (has_triangles, has_spheres) = (has(SubmissionPart::Triangle), has(SubmissionPart::Sphere));
    if has_triangles && has_spheres {
        return Cow::Borrowed(shapes);
    }
    let is_written = |shape: &&Shape| match shape {
        Shape::Triangle { .. } | Shape::FlatTriangle { .. } => has_triangles,
        Shape::Sphere { .. } => has_spheres,
    };
    Cow::Owned(shapes.iter().filter(is_written).copied().collect())
}

/// The tree to traverse.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum TreeSource {
    /// The tree built by the submission's `Bvh::build`.
    Build,
    /// A tree from the exam.
    Prebuilt(Tree),
    /// No tree: all primitives are tested.
    List,
}

/// A camera and the settings for paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The camera and its position.
    pub camera: Camera,
    /// The settings.
    pub settings: PathSettings,
}
