//! The interface between the framework and the code that students write.

use protocol::{Ray, Trace, TreeNode};

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

/// A list of primitives as a tree without nodes.
pub struct List(pub Box<dyn Aggregate>);

impl Aggregate for List {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        self.0.closest_hit(ray)
    }
}

impl Hierarchy for List {
    fn root(&self) -> usize {
        0
    }

    fn node_count(&self) -> usize {
        0
    }

    fn node(&self, index: usize) -> TreeNode {
        unreachable!("a list has no node {index}")
    }

    fn primitive_count(&self) -> usize {
        0
    }

    fn shape(&self, index: usize) -> u32 {
        unreachable!("primitive {index} of a list is never read")
    }
}
