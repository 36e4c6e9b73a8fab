//! Questions that the grader asks the probe.

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::interval::Interval;
use crate::packed;
use crate::ray::Ray;
use crate::shape::Shape;
use crate::tree::TreeNode;
use crate::view::{PinholeCamera, Rays, Samples};

/// A question about one subject, such as a camera, a list of shapes or a tree. It consists of
/// elements (samples, rays, a tree to build) that are answered separately, so that a panic affects
/// only its own element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Calls `Camera::sample_ray` once for each sample.
    Camera {
        /// The camera that generates the rays.
        camera: PinholeCamera,
        /// The positions on its film.
        samples: Samples,
    },
    /// Calls `hit` of every shape for each ray, and takes the closest hit. No tree is involved.
    Shapes {
        /// The shapes, tested one after the other.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The rays to intersect with the shapes.
        rays: Rays,
    },
    /// Calls `BBox::hit` once for each ray and its times.
    #[serde(rename = "bbox")]
    BBox {
        /// The corner of the box with the smallest coordinates.
        min: Vec3,
        /// The corner of the box with the largest coordinates.
        max: Vec3,
        /// The rays, each with the `times` to pass to `BBox::hit`.
        #[serde(with = "packed")]
        queries: Vec<(Ray, Interval)>,
    },
    /// Calls `Bvh::build` once. The answer is the whole tree.
    Build {
        /// The primitives, each with a different material.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The maximum number of primitives in a leaf.
        max_leaf_size: u32,
    },
    /// Calls `Bvh::hit` once for each ray, on the tree that the question contains.
    Traverse {
        /// The primitives, in the order that the leaves index them.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The nodes, in any order.
        #[serde(with = "packed")]
        nodes: Vec<TreeNode>,
        /// The index of the root in `nodes`.
        root: u32,
        /// The rays to intersect with the tree.
        rays: Rays,
    },
    /// Calls `Bvh::hit` once for each ray, on the tree that the submission's `Bvh::build` returns.
    BuildAndTraverse {
        /// The primitives to build the tree over.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The maximum number of primitives in a leaf.
        max_leaf_size: u32,
        /// The rays to intersect with the built tree.
        rays: Rays,
    },
    /// Renders a path-traced picture. The framework draws every random number.
    Radiance {
        /// The scene, as the text of a scene file that needs no other file.
        scene: String,
        /// The number of pixels, across and up.
        film: UVec2,
        /// The number of paths per pixel.
        samples: u32,
        /// The maximum number of times that a path is scattered.
        bounces: u32,
        /// The seed of all random numbers.
        seed: u64,
    },
    /// Marks the end of the questions and has no elements. The answer to it shows that all earlier
    /// questions have been answered.
    Done,
}

impl Question {
    /// Returns the number of elements, which is also the number of outcomes in the answer.
    pub fn count(&self) -> usize {
        match self {
            Question::Camera { camera, samples } => samples.count(camera.film),
            Question::Shapes { rays, .. }
            | Question::Traverse { rays, .. }
            | Question::BuildAndTraverse { rays, .. } => rays.count(),
            Question::BBox { queries, .. } => queries.len(),
            Question::Build { .. } | Question::Radiance { .. } => 1,
            Question::Done => 0,
        }
    }

    /// Returns the rays of a question that asks for the hits of rays.
    pub fn rays(&self) -> Option<&Rays> {
        match self {
            Question::Shapes { rays, .. }
            | Question::Traverse { rays, .. }
            | Question::BuildAndTraverse { rays, .. } => Some(rays),
            Question::Camera { .. }
            | Question::BBox { .. }
            | Question::Build { .. }
            | Question::Radiance { .. }
            | Question::Done => None,
        }
    }

    /// Returns the maximum number of nodes in a tree over this many primitives. A binary tree with
    /// one primitive per leaf has `2n - 1`; the limit is higher to allow for unused nodes.
    pub fn max_nodes(primitives: usize) -> usize {
        primitives.saturating_mul(4).saturating_add(64)
    }

    /// Returns an upper bound on the size of a well-formed answer on the wire, in bytes.
    pub fn max_answer_bytes(&self) -> usize {
        // A Trace is 12 floats and a varint; a Panic is bounded text.
        const ELEMENT_BYTES: usize = 64;
        const PANIC_BYTES: usize = 16 * 1024;
        let elements = match self {
            Question::Camera { .. }
            | Question::Shapes { .. }
            | Question::Traverse { .. }
            | Question::BuildAndTraverse { .. }
            | Question::BBox { .. }
            | Question::Done => self.count(),
            Question::Build { shapes, .. } => {
                Self::max_nodes(shapes.len()).saturating_add(shapes.len())
            }
            Question::Radiance { film, .. } => (film.x as usize).saturating_mul(film.y as usize),
        };
        elements
            .saturating_mul(ELEMENT_BYTES)
            .saturating_add(PANIC_BYTES)
    }
}
