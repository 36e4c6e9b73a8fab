use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A node of a [`Tree`]. It is a leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeNode {
    /// The corner of the node's box with the smallest coordinates.
    pub min: Vec3,
    /// The corner of the node's box with the largest coordinates.
    pub max: Vec3,
    /// The index of a leaf's first primitive. Ignored in interior nodes.
    pub start: u32,
    /// The number of primitives in a leaf. Ignored in interior nodes.
    pub size: u32,
    /// In an interior node, the index of one child.
    pub l: u32,
    /// In an interior node, the index of the other child.
    pub r: u32,
}

impl TreeNode {
    /// Creates a node with the box from `min` to `max`, converting indices to `u32`.
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

    /// Converts an index to `u32`. An index that doesn't fit becomes `u32::MAX`, so that it stays
    /// out of range instead of wrapping around to a valid index.
    pub fn saturating_index(index: usize) -> u32 {
        u32::try_from(index).unwrap_or(u32::MAX)
    }

    /// Returns whether the node is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy as data. The primitives are listed separately: as shapes in a
/// question, and by their numbers (`order`) in an answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// The nodes, in any order.
    pub nodes: Vec<TreeNode>,
    /// The index of the root in `nodes`.
    pub root: u32,
    /// The primitives' numbers, in the order of the list that the leaves refer to.
    pub order: Vec<u32>,
}
