use glam::Vec3;
use serde::{Deserialize, Serialize};

/// One node of a [`Tree`]: a leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeNode {
    /// The smallest corner of the node's box.
    pub min: Vec3,
    /// The largest corner of the node's box.
    pub max: Vec3,
    /// In a leaf, the place of its first primitive; not read elsewhere.
    pub start: u32,
    /// In a leaf, the number of its primitives; not read elsewhere.
    pub size: u32,
    /// In an interior node, the place of one child.
    pub l: u32,
    /// In an interior node, the place of the other child.
    pub r: u32,
}

impl TreeNode {
    /// A node between two corners, with places as programs count them.
    pub fn new(min: Vec3, max: Vec3, start: usize, size: usize, l: usize, r: usize) -> Self {
        TreeNode {
            min,
            max,
            start: TreeNode::saturating_index(start),
            size: TreeNode::saturating_index(size),
            l: TreeNode::saturating_index(l),
            r: TreeNode::saturating_index(r),
        }
    }

    /// A place as it is told. What does not fit is out of range anyway, and must not wrap into range.
    pub fn saturating_index(place: usize) -> u32 {
        u32::try_from(place).unwrap_or(u32::MAX)
    }

    /// Former name of [`TreeNode::saturating_index`].
    #[doc(hidden)]
    pub fn place(index: usize) -> u32 {
        TreeNode::saturating_index(index)
    }

    /// Whether the node is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy, as data. The primitives that `start` and `size` count are listed
/// beside it: as shapes in a question, as materials (`order`) in an answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// The nodes, in any order.
    pub nodes: Vec<TreeNode>,
    /// The place of the node where everything starts.
    pub root: u32,
    /// The material of each primitive, in the order that the leaves count.
    pub order: Vec<u32>,
}
