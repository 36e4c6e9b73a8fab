//! Defects of trees and their descriptions in reports.

use crate::describe;
use crate::symptom::Side;

use super::bounds::Bounds;
use super::reached_nodes::ReachedNode;
use super::{FULL_MARKS_RATIO, HALF_MARKS_RATIO};
use protocol::TreeNode;

/// A defect of a tree.
#[derive(Clone, Debug)]
pub enum TreeDefect {
    /// The question contains primitives, but the tree is empty.
    NoNodes {
        /// The number of primitives in the question.
        primitives: usize,
    },
    /// The index of the root or a child is out of range.
    UnknownNode {
        /// The field that contains the index.
        field: &'static str,
        /// The index.
        index: u32,
        /// The number of nodes.
        nodes: usize,
    },
    /// Two paths from the root lead to the same node.
    ReachedTwice {
        /// The index of the node.
        index: u32,
    },
    /// The leaves list too many primitives in total, so not all leaves were read.
    TooManyListed {
        /// The maximum number of listed primitives.
        most: usize,
        /// The number of primitives in the question.
        primitives: usize,
    },
    /// A leaf lists primitives that don't exist.
    UnknownPrimitives {
        /// The index of the leaf.
        leaf: u32,
        /// The first of its primitives.
        start: u32,
        /// The number of its primitives.
        size: u32,
        /// The number of primitives in the tree.
        listed: usize,
    },
    /// A primitive is in no leaf, or in several.
    Partition {
        /// The index of the primitive.
        primitive: usize,
        /// The number of primitives in the question.
        primitives: usize,
        /// The number of leaves that contain it.
        leaves: usize,
    },
    /// A box doesn't contain everything below its node.
    BoxTooSmall(NodeBox),
    /// A box is larger than necessary.
    BoxTooLarge(NodeBox),
    /// A leaf has at least half of all primitives.
    NotSplit {
        /// The index of the leaf.
        leaf: u32,
        /// The number of its primitives.
        count: usize,
        /// The number of primitives in the question.
        all: usize,
    },
    /// A leaf has too many primitives.
    LeafTooLarge {
        /// The index of the leaf.
        leaf: u32,
        /// The number of its primitives.
        count: usize,
        /// The maximum number of primitives in a leaf.
        most: usize,
    },
    /// A node was split although its primitives would fit in a leaf.
    NeedlessSplit {
        /// The index of the node.
        node: u32,
        /// The number of its primitives.
        count: usize,
        /// The maximum number of primitives in a leaf.
        most: usize,
    },
    /// The tree's cost is too high.
    Cost {
        /// The cost as a multiple of the exact sweep's cost.
        ratio: f64,
        /// The numbers of primitives below the root's children, unless the root is a leaf.
        root_split: Option<[usize; 2]>,
    },
}

/// A node and the tightest box around its primitives.
#[derive(Clone, Copy, Debug)]
pub struct NodeBox {
    /// The index of the node.
    pub index: u32,
    node: TreeNode,
    /// The tightest box.
    pub tight: Bounds,
}

impl NodeBox {
    pub(super) fn of(node: &ReachedNode) -> Self {
        NodeBox {
            index: node.index,
            node: *node.node,
            tight: node.tight_bounds,
        }
    }
}

impl TreeDefect {
    /// Returns the node with the defect, or `None` if the defect concerns the entire tree.
    pub fn node(&self) -> Option<u32> {
        match self {
            TreeDefect::BoxTooSmall(node) | TreeDefect::BoxTooLarge(node) => Some(node.index),
            TreeDefect::UnknownPrimitives { leaf: index, .. }
            | TreeDefect::LeafTooLarge { leaf: index, .. }
            | TreeDefect::NotSplit { leaf: index, .. }
            | TreeDefect::NeedlessSplit { node: index, .. }
            | TreeDefect::ReachedTwice { index } => Some(*index),
            TreeDefect::NoNodes { .. }
            | TreeDefect::UnknownNode { .. }
            | TreeDefect::TooManyListed { .. }
            | TreeDefect::Partition { .. }
            | TreeDefect::Cost { .. } => None,
        }
    }

    /// Returns the name of the wrong part or property.
    pub fn what(&self) -> &'static str {
        match self {
            TreeDefect::NoNodes { .. } | TreeDefect::ReachedTwice { .. } => "nodes",
            TreeDefect::UnknownNode { field, .. } => field,
            TreeDefect::TooManyListed { .. }
            | TreeDefect::UnknownPrimitives { .. }
            | TreeDefect::Partition { .. } => "leaves",
            TreeDefect::BoxTooSmall(_) => "box too small",
            TreeDefect::BoxTooLarge(_) => "box too large",
            TreeDefect::NotSplit { .. } | TreeDefect::NeedlessSplit { .. } => "splits",
            TreeDefect::LeafTooLarge { .. } => "leaf size",
            TreeDefect::Cost { .. } => "SAH cost",
        }
    }

    /// Returns whether the wrong part or property is too small or too large, if that can be
    /// determined.
    pub fn side(&self) -> Option<Side> {
        match self {
            TreeDefect::NoNodes { .. } | TreeDefect::NotSplit { .. } => Some(Side::Less),
            TreeDefect::Partition { leaves, .. } => Some(Side::of_presence(*leaves > 0)),
            TreeDefect::ReachedTwice { .. }
            | TreeDefect::TooManyListed { .. }
            | TreeDefect::NeedlessSplit { .. } => Some(Side::More),
            TreeDefect::UnknownNode { .. }
            | TreeDefect::UnknownPrimitives { .. }
            | TreeDefect::BoxTooSmall(_)
            | TreeDefect::BoxTooLarge(_)
            | TreeDefect::LeafTooLarge { .. }
            | TreeDefect::Cost { .. } => None,
        }
    }

    /// Returns the value in the submission's tree.
    pub fn got(&self) -> String {
        match self {
            TreeDefect::NoNodes { .. } => "no node at all".to_owned(),
            TreeDefect::UnknownNode { index, nodes, .. } => format!("node {index} of {nodes}"),
            TreeDefect::ReachedTwice { index } => format!("node {index} is reached twice"),
            TreeDefect::TooManyListed { most, .. } => {
                format!("leaves that hold more than {most} primitives in all")
            }
            TreeDefect::UnknownPrimitives {
                leaf,
                start,
                size,
                listed,
            } => {
                format!(
                    "leaf {leaf} has start {start} and size {size}, but only {listed} are listed"
                )
            }
            TreeDefect::Partition {
                primitive,
                primitives,
                leaves,
            } => format!("primitive {primitive} of {primitives} is in {leaves} leaves"),
            TreeDefect::BoxTooSmall(NodeBox { index, node, .. })
            | TreeDefect::BoxTooLarge(NodeBox { index, node, .. }) => {
                let [min, max] = [node.min, node.max].map(describe::point);
                format!("node {index}: {min} to {max}")
            }
            TreeDefect::NotSplit { leaf, count, all } => {
                format!("leaf {leaf} holds {count} of {all} primitives")
            }
            TreeDefect::LeafTooLarge { leaf, count, .. } => {
                format!("leaf {leaf} holds {count} primitives")
            }
            TreeDefect::NeedlessSplit { node, count, .. } => {
                format!("node {node} with {count} primitives was split")
            }
            TreeDefect::Cost { ratio, root_split } => {
                let root = root_split.map_or(String::new(), |[l, r]| {
                    let all = l + r;
                    format!(" (the root splits {all} primitives into {l} and {r})")
                });
                format!("{ratio:.2} times the cost with the best split at every node{root}")
            }
        }
    }

    /// Returns the expected value.
    pub fn wanted(&self) -> String {
        match self {
            TreeDefect::NoNodes { primitives } => format!("a tree over {primitives} primitives"),
            TreeDefect::UnknownNode { .. } => "the index of a node".to_owned(),
            TreeDefect::ReachedTwice { .. } => "a tree, with one path to each node".to_owned(),
            TreeDefect::TooManyListed { primitives, .. } => {
                format!("each of the {primitives} primitives in one leaf")
            }
            TreeDefect::UnknownPrimitives { .. } => {
                "a range within the tree's list of primitives".to_owned()
            }
            TreeDefect::Partition { .. } => "each primitive in exactly one leaf".to_owned(),
            TreeDefect::BoxTooSmall(NodeBox { tight, .. })
            | TreeDefect::BoxTooLarge(NodeBox { tight, .. }) => {
                let [min, max] = [tight.min, tight.max].map(|at| describe::point(at.as_vec3()));
                format!("{min} to {max}")
            }
            TreeDefect::NotSplit { .. } => {
                "fewer than half of the primitives in each leaf".to_owned()
            }
            TreeDefect::LeafTooLarge { most, .. } => format!("at most {most}"),
            TreeDefect::NeedlessSplit { most, .. } => {
                format!("a leaf if there are at most {most} primitives")
            }
            TreeDefect::Cost { .. } => format!(
                "at most {FULL_MARKS_RATIO:.2} times ({HALF_MARKS_RATIO:.2} for half the points)"
            ),
        }
    }
}
