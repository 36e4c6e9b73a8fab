//! The one seam between what is given and what students write.
//!
//! Called through `dyn`, and as narrow as it can be: what is on the other side is compiled with every
//! submission, and every submission waits for it. No method has the name of one that students write:
//! where theirs is missing, the compiler has to say so, and not to call this one in its place.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, Trace, Tree, TreeNode};

use crate::scene::Scene;

/// The five files of a submission, behind what is given in `world.rs`: makes its own types of what a
/// scene or a question describes.
pub trait Submission: Sync {
    /// `Camera::new`.
    fn camera(&self, lens: &PinholeCamera) -> Box<dyn CameraRays>;

    /// Primitives by themselves, without a tree.
    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate>;

    /// `BBox::hit`, of the box between these corners.
    fn intersect_box(&self, min: Vec3, max: Vec3, ray: &Ray, times: Interval) -> Option<Interval>;

    /// `Bvh::build`.
    fn build(&self, shapes: &[Shape], max_leaf_size: usize) -> Box<dyn Hierarchy>;

    /// `Bvh::from_nodes`.
    fn prebuilt_tree(
        &self,
        shapes: &[Shape],
        nodes: &[TreeNode],
        root: usize,
    ) -> Box<dyn Hierarchy>;
}

/// A submission's camera.
pub trait CameraRays: Sync {
    /// `Camera::sample_ray`, in camera space.
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray;
}

/// Primitives of a submission.
pub trait Aggregate: Sync {
    /// The closest hit of all.
    fn closest_hit(&self, ray: &Ray) -> Option<Trace>;
}

/// A submission's tree.
pub trait Hierarchy: Aggregate {
    /// The place of the root.
    fn root(&self) -> usize;

    /// How many nodes there are.
    fn node_count(&self) -> usize;

    /// One of them.
    fn node(&self, place: usize) -> TreeNode;

    /// How many primitives there are.
    fn primitive_count(&self) -> usize;

    /// The material of one of them, in the order that the leaves count.
    fn material(&self, place: usize) -> u32;
}

impl dyn Hierarchy {
    /// The same, as data.
    pub fn tree(&self) -> Tree {
        Tree {
            nodes: (0..self.node_count())
                .map(|place| self.node(place))
                .collect(),
            root: TreeNode::saturating_index(self.root()),
            order: (0..self.primitive_count())
                .map(|place| self.material(place))
                .collect(),
        }
    }
}

/// A scene made of a submission's own types: all that the integrator sees of it.
pub struct World {
    camera: Box<dyn CameraRays>,
    bvh: Box<dyn Hierarchy>,
}

impl World {
    /// The submission's own of this scene.
    pub fn new(submission: &dyn Submission, scene: &Scene) -> Self {
        World {
            camera: submission.camera(&scene.camera.pinhole),
            bvh: submission.build(&scene.shapes, scene.max_leaf_size),
        }
    }

    /// `Camera::sample_ray`, in camera space.
    pub fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        self.camera.ray(pixel, offset)
    }

    /// `Bvh::hit`, in world space.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.bvh.closest_hit(ray)
    }

    /// The tree that `Bvh::build` made.
    pub fn tree(&self) -> Tree {
        self.bvh.tree()
    }
}
