//! The parts of a submission that are created once and called many times.
//!
//! These traits and [`Submission`](crate::Submission) are used through `dyn` and are as small as
//! possible, because their implementations are compiled together with every submission. The
//! methods' names differ from those of the students' methods. Otherwise, if a student's method were
//! missing, the compiler could resolve the call to the trait's method instead of reporting an
//! error.

use glam::{UVec2, Vec2};

use crate::ray::{Ray, Trace};
use crate::tree::{Tree, TreeNode};

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

    /// Returns the number of the primitive at `index` in the list that the leaves refer to.
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
