//! What a submission can be asked.

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::interval::Interval;
use crate::packed;
use crate::ray::Ray;
use crate::shape::Shape;
use crate::tree::TreeNode;
use crate::view::{PinholeCamera, Rays, Samples};

/// One subject, and all that is asked of it. Each element (a ray, a sample, a tree) is answered
/// apart: a panic costs only its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// `Camera::sample_ray`, once for each sample.
    Camera {
        /// The camera to ask.
        camera: PinholeCamera,
        /// The places on its film.
        samples: Samples,
    },
    /// The nearest of the answers that each shape's own `hit` gives, for each ray: no tree.
    Shapes {
        /// The shapes, asked one after the other.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The rays.
        rays: Rays,
    },
    /// `BBox::hit`, once for each ray and its times.
    #[serde(rename = "bbox")]
    BBox {
        /// The smallest corner of the box.
        min: Vec3,
        /// The largest corner of the box.
        max: Vec3,
        /// The rays, each with the times that count.
        #[serde(with = "packed")]
        #[serde(alias = "shots")]
        queries: Vec<(Ray, Interval)>,
    },
    /// `Bvh::build`: the whole tree is the answer.
    Build {
        /// The primitives, each with its own material.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The most primitives that a leaf may hold.
        max_leaf_size: u32,
    },
    /// `Bvh::hit` on this tree, once for each ray.
    Traverse {
        /// The primitives, in the order that the leaves count.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The nodes, in any order.
        #[serde(with = "packed")]
        nodes: Vec<TreeNode>,
        /// The place of the node where everything starts.
        root: u32,
        /// The rays.
        rays: Rays,
    },
    /// `Bvh::hit` on the tree that the submission's own `Bvh::build` makes, once for each ray.
    BuildAndTraverse {
        /// The primitives.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The most primitives that a leaf may hold.
        max_leaf_size: u32,
        /// The rays.
        rays: Rays,
    },
    /// A path-traced picture, with every random number drawn by the framework.
    Radiance {
        /// The scene, as the text of a scene file that needs no other file.
        scene: String,
        /// The number of pixels, across and up.
        film: UVec2,
        /// Paths for each pixel.
        samples: u32,
        /// The most times that a path may be scattered.
        bounces: u32,
        /// What all random numbers follow from.
        seed: u64,
    },
    /// Nothing: whoever answers has answered all that came before.
    Done,
}

impl Question {
    /// How many elements are asked, and so answered.
    pub fn count(&self) -> usize {
        match self {
            Question::Camera { camera, samples } => samples.count(camera.film),
            Question::Shapes { rays, .. }
            | Question::Traverse { rays, .. }
            | Question::BuildAndTraverse { rays, .. } => rays.count(),
            Question::BBox { queries: shots, .. } => shots.len(),
            Question::Build { .. } | Question::Radiance { .. } => 1,
            Question::Done => 0,
        }
    }

    /// The most nodes that are read of a tree over this many primitives: a binary tree with a
    /// primitive in each leaf needs `2n - 1`; the rest is room for nodes left unused.
    pub fn max_nodes(primitives: usize) -> usize {
        primitives.saturating_mul(4).saturating_add(64)
    }

    /// The most bytes that an honest answer takes on the wire.
    pub fn max_answer_bytes(&self) -> usize {
        // A Trace is 12 floats and a varint; a Panic is bounded text.
        const ELEMENT: usize = 64;
        const PANICS: usize = 16 * 1024;
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
        elements.saturating_mul(ELEMENT).saturating_add(PANICS)
    }
}
