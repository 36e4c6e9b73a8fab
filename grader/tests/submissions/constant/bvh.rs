//! Task 3: a tree of boxes, built (step 1) and walked (step 2). Handout: "Building a BVH" and
//! "Walking a BVH".
//!
//! ```text
//!     ┌───────────────┐                     root
//!     │ ┌────┐ ┌────┐ │                    ╱    ╲
//!     │ │ △△ │ │  △ │ │                   A      B       a leaf holds
//!     │ │ △  │ │ △  │ │                 △△△      △△      primitives[start..start + size]
//!     │ └─A──┘ └──B─┘ │
//!     └───────────────┘       SAH:  C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect
//! ```

use protocol::{Ray, Trace};

use crate::bbox::BBox;
use crate::primitive::Primitive;

/// One box of the tree. A leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Holds everything below this node.
    pub bbox: BBox,
    /// In a leaf, the place of its first primitive; elsewhere not read.
    pub start: usize,
    /// In a leaf, the number of its primitives; elsewhere not read.
    pub size: usize,
    /// In an interior node, the place of one child in `Bvh::nodes`.
    pub l: usize,
    /// In an interior node, the place of the other.
    pub r: usize,
}

impl Node {
    /// A node that holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// A node that holds two others.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Whether the node holds primitives.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy: a binary tree of boxes around primitives.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives; those of one leaf stand side by side.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. None at all if there is nothing to hold.
    pub nodes: Vec<Node>,
    /// The place of the node where everything starts: need be neither first nor last.
    pub root: usize,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh {
            primitives,
            nodes,
            root,
        }
    }

    /// Builds the tree by the surface area heuristic.
    ///
    /// - Every primitive is in exactly one leaf. They may be reordered, and so may the nodes.
    /// - A node's box holds all that is below it, and nothing beyond what that needs.
    /// - A node becomes a leaf when, and only when, it has at most `max_leaf_size` (one or more)
    ///   primitives. If no plane separates them, because their centers coincide, split by count.
    /// - Of the partitions between 8 or more buckets along each of the three axes, the cheapest
    ///   by the formula above is taken.
    /// - No primitives: no nodes, or one leaf of size 0.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let _ = max_leaf_size;
        let mut bbox = BBox::EMPTY;
        for primitive in &primitives {
            bbox.enclose(primitive.bbox());
        }
        let leaf = Node::leaf(bbox, 0, primitives.len());
        Bvh::from_nodes(primitives, vec![leaf], 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    ///
    /// - A node whose box the ray misses is not entered.
    /// - Of two children, the one whose box the ray enters first goes first.
    /// - A node whose box begins beyond the closest hit so far is not entered. The slides'
    ///   pseudo-code compares `hit2.t`, which is child 2's even where child 1 comes second, and
    ///   enters `first` even if both boxes are missed: mind both.
    /// - The closest hit need not be in the first leaf: boxes overlap.
    /// - A tree may be 60 levels deep, or have no nodes.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let _ = ray;
        None
    }
    // Room for helpers of your own.
}
