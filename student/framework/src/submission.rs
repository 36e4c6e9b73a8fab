//! The interface between the framework and the code that students write.
//!
//! The traits are used through `dyn` and are as small as possible, because their implementations
//! are compiled together with every submission. The names of the methods differ from the names that
//! students write. Otherwise, if a student's method were missing, the compiler could resolve the
//! call to the trait's method instead of reporting an error.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, Trace, Tree, TreeNode};

use crate::scene::Scene;

/// A submission's files, called through the given file `world.rs`, which implements this
/// trait. The methods convert the cameras, shapes and nodes in a scene or a question to the
/// submission's own types.
pub trait Submission: Sync {
    /// Calls `Camera::new`.
    fn camera(&self, pinhole: &PinholeCamera) -> Box<dyn CameraRays>;

    /// Creates a list of primitives, without a tree.
    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate>;

    /// Calls `BBox::hit` of the box between these corners.
    fn intersect_box(&self, min: Vec3, max: Vec3, ray: &Ray, times: Interval) -> Option<Interval>;

    /// Calls `reflect`, in a frame whose +z is the normal.
    fn reflect(&self, _toward_viewer: Vec3) -> Vec3 {
        unimplemented!("this assignment has no mirrors")
    }

    /// Calls `Bvh::build`.
    fn build(&self, shapes: &[Shape], max_leaf_size: usize) -> Box<dyn Hierarchy>;

    /// Calls `Bvh::from_nodes`.
    fn prebuilt_tree(
        &self,
        shapes: &[Shape],
        nodes: &[TreeNode],
        root: usize,
    ) -> Box<dyn Hierarchy>;
}

/// A submission's camera.
pub trait CameraRays: Send + Sync {
    /// Calls `Camera::sample_ray`. The ray is in camera space.
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray;
}

/// A list or tree of a submission's primitives.
pub trait Aggregate: Send + Sync {
    /// Returns the closest hit on any of the primitives.
    fn closest_hit(&self, ray: &Ray) -> Option<Trace>;
}

/// A submission's tree.
pub trait Hierarchy: Aggregate {
    /// Returns the index of the root.
    fn root(&self) -> usize;

    /// Returns the number of nodes.
    fn node_count(&self) -> usize;

    /// Returns the node at `index`.
    fn node(&self, index: usize) -> TreeNode;

    /// Returns the number of primitives.
    fn primitive_count(&self) -> usize;

    /// Returns the number of the primitive at `index`, in the order that the leaves index them.
    fn shape(&self, index: usize) -> u32;
}

impl dyn Hierarchy {
    /// Returns the whole tree as data.
    pub fn tree(&self) -> Tree {
        Tree {
            nodes: (0..self.node_count())
                .map(|index| self.node(index))
                .collect(),
            root: TreeNode::saturating_index(self.root()),
            order: (0..self.primitive_count())
                .map(|index| self.shape(index))
                .collect(),
        }
    }
}

/// A scene's camera and primitives, converted to a submission's own types. The integrator calls the
/// submission only through this type.
pub struct World {
    /// The camera. Its rays are in camera space.
    pub camera: Box<dyn CameraRays>,
    /// The tree that `Bvh::build` has built. Its rays are in world space.
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
