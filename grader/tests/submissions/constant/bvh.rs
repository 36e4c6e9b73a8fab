//! Task 3: building a tree of boxes (step 1) and traversing it (step 2). Handout: "Building a BVH"
//! and "Traversing a BVH".
//!
//! ```text
//!     ┌───────────────┐                     root
//!     │ ┌────┐ ┌────┐ │                    ╱    ╲
//!     │ │ △△ │ │  △ │ │                   A      B       a leaf holds
//!     │ │ △  │ │ △  │ │                 △△△      △△      primitives[start..start + size]
//!     │ └─A──┘ └──B─┘ │
//!     └───────────────┘       SAH:  C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect
//! ```
//!
//! | on the slides | here |
//! |---|---|
//! | `Node`, `BVHNode` | [`Node`] |
//! | `child1`, `child2` | `l` and `r`, indices into [`Bvh::nodes`] |
//! | `leaf`, `primList` | [`Node::is_leaf`], `primitives[start..start + size]` |
//! | `Bbox.enclose`, `Bbox.center` | [`BBox::enclose`], [`BBox::center`] |
//! | `intersect(ray, child->bbox)`, `hit1.t` | [`BBox::hit`], the `min` of its result |
//! | `HitInfo`, `best.t` | [`Trace`], its `distance` |
//! | `std::partition` | a loop with `swap`, or `Iterator::partition` |

use protocol::{Ray, Trace};

use crate::bbox::BBox;
use crate::primitive::Primitive;

/// A node of the tree. It is a leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The box around everything below this node.
    pub bbox: BBox,
    /// In a leaf, the index of its first primitive in [`Bvh::primitives`]. Ignored in other nodes.
    pub start: usize,
    /// In a leaf, the number of its primitives. Ignored in other nodes.
    pub size: usize,
    /// In an interior node, the index of one child in [`Bvh::nodes`].
    pub l: usize,
    /// In an interior node, the index of the other child in [`Bvh::nodes`].
    pub r: usize,
}

impl Node {
    /// Creates a leaf, which holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// Creates an interior node, which has two children.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Returns whether the node is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy: a binary tree of boxes around primitives.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives. Those of one leaf are next to each other.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. A tree without primitives may have no nodes.
    pub nodes: Vec<Node>,
    /// The index of the root in `nodes`. The root can be any node, not only the first or the last.
    pub root: usize,
}

impl Bvh {
    /// Creates a tree from its primitives, its nodes and the index of its root.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh {
            primitives,
            nodes,
            root,
        }
    }

    /// Builds the tree with the surface area heuristic (SAH).
    ///
    /// - Every primitive is in exactly one leaf. You may reorder the primitives and the nodes.
    /// - The box of a node contains everything below the node, and is no larger than necessary.
    /// - A node is a leaf if and only if it has at most `max_leaf_size` primitives (1 or more). If
    ///   all centres coincide, no plane separates the primitives: then split them by count.
    /// - Use 8 or more buckets along each of the three axes, and take the partition with the lowest
    ///   cost by the formula at the top of this file.
    /// - Without primitives, the tree has no nodes, or one leaf of size 0.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let _ = max_leaf_size;
        let mut bbox = BBox::EMPTY;
        for primitive in &primitives {
            bbox.enclose(primitive.bbox());
        }
        let leaf = Node::leaf(bbox, 0, primitives.len());
        Bvh::from_nodes(primitives, vec![leaf], 0)
    }

    /// Returns the ray's closest hit on any primitive, or `None` if there is none within
    /// `ray.range`.
    ///
    /// - Do not enter a node whose box the ray misses.
    /// - If the ray hits the boxes of both children, visit the child whose box it enters first.
    /// - Do not enter a node whose box begins beyond the closest hit so far.
    /// - Boxes overlap, so the closest hit can be in a leaf that you visit later.
    /// - The tree can be 60 levels deep, and it can have no nodes.
    ///
    /// Do not take the slides' pseudo-code literally. It compares `hit2.t`, the entry of `child2`,
    /// even if `second` is `child1`. It also enters `first` even if the ray misses both boxes.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let _ = ray;
        None
    }
    // Add your own methods here.
}
