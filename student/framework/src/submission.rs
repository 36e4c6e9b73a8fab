//! The interface between the framework and the code that students write.

use crate::scene::Scene;

pub use protocol::{Aggregate, CameraRays, Hierarchy, Submission};

/// A scene's camera and primitives, converted to a submission's own types. The integrator calls the
/// submission only through this type.
pub struct World {
    /// The camera. Its rays are in camera space.
    pub camera: Box<dyn CameraRays>,
    /// The tree built by `Bvh::build`. It takes rays in world space.
    pub bvh: Box<dyn Hierarchy>,
}

impl World {
    /// Converts a scene to the submission's types, which includes building a tree over the shapes.
    pub fn new(submission: &dyn Submission, scene: &Scene) -> Self {
        World {
            camera: submission.camera(&scene.camera.pinhole),
            bvh: submission.build(&scene.shapes, scene.max_leaf_size),
        }
    }
}
