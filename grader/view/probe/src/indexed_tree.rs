//! A submission's tree with lookups. The tree may be invalid, so nothing here assumes that the
//! nodes really form a tree.

use std::collections::HashMap;

use glam::Vec3;
use protocol::{Tree, TreeNode};

/// The maximum number of nodes to list for one box.
const MAX_EQUAL: usize = 100;
/// The maximum number of leaves to read per primitive, on average. Without this limit, indexing
/// would take too long if all leaves contained all primitives.
const MAX_LEAVES: usize = 64;

/// A tree whose nodes can be looked up by their boxes, their primitives or their children.
#[derive(Clone, Debug, Default)]
pub struct IndexedTree {
    /// The tree.
    pub tree: Tree,
    /// The parent of each node. `None` for the root and for nodes that aren't reached from it.
    parents: Vec<Option<u32>>,
    /// The level of each node, 0 for the root. `None` for nodes that aren't reached from it.
    levels: Vec<Option<u32>>,
    /// The number of primitives in the leaves below each node.
    counts: Vec<u32>,
    /// The nodes that are reached from the root, in depth-first order.
    pub order: Vec<u32>,
    /// The number of levels.
    depth: u32,
    /// For each primitive's number, the first leaf in depth-first order that contains the
    /// primitive.
    leaves: HashMap<u32, u32>,
    /// The nodes, sorted by the bits of their boxes.
    by_box: Vec<u32>,
}

impl IndexedTree {
    /// Indexes a tree of n nodes in O(n log n) time, no matter what its nodes refer to.
    pub fn new(tree: Tree) -> Self {
        let nodes = tree.nodes.len();
        let mut indexed = IndexedTree {
            parents: vec![None; nodes],
            levels: vec![None; nodes],
            counts: vec![0; nodes],
            order: Vec::new(),
            depth: 0,
            leaves: HashMap::new(),
            by_box: Vec::new(),
            tree,
        };
        indexed.visit();
        indexed.by_box.clone_from(&indexed.order);
        let nodes = &indexed.tree.nodes;
        indexed
            .by_box
            .sort_by_key(|node| bits(&nodes[*node as usize]));
        indexed
    }

    /// Visits each node that can be reached from the root, exactly once, and fills in the lists.
    fn visit(&mut self) {
        let mut stack = vec![(self.tree.root, None, 0)];
        let mut left = MAX_LEAVES * self.tree.order.len();
        while let Some((index, parent, level)) = stack.pop() {
            let Some(node) = self.tree.nodes.get(index as usize).copied() else {
                continue;
            };
            let slot = &mut self.levels[index as usize];
            // A node that was already visited has a second parent, or the tree contains a cycle.
            if slot.is_some() {
                continue;
            }
            *slot = Some(level);
            self.depth = self.depth.max(level + 1);
            self.parents[index as usize] = parent;
            self.order.push(index);
            if node.is_leaf() {
                let order = &self.tree.order;
                let first = order.len().min(node.start as usize);
                let end = order.len().min(first.saturating_add(node.size as usize));
                self.counts[index as usize] = TreeNode::saturating_index(end - first);
                let read = first..end.min(first + left);
                left -= read.len();
                for number in &order[read] {
                    self.leaves.entry(*number).or_insert(index);
                }
            } else {
                stack.push((node.r, Some(index), level + 1));
                stack.push((node.l, Some(index), level + 1));
            }
        }
        for index in self.order.iter().rev() {
            let count = self.counts[*index as usize];
            if let Some(parent) = self.parents[*index as usize] {
                let sum = &mut self.counts[parent as usize];
                *sum = sum.saturating_add(count);
            }
        }
    }

    /// Returns whether the tree contains any nodes.
    pub fn has_nodes(&self) -> bool {
        !self.order.is_empty()
    }

    /// Returns the number of levels.
    pub fn levels(&self) -> u32 {
        self.depth
    }

    /// Returns the level of a node, if it is reached from the root.
    pub fn level(&self, node: u32) -> Option<u32> {
        self.levels.get(node as usize).copied().flatten()
    }

    /// Returns the parent of a node.
    pub fn parent(&self, node: u32) -> Option<u32> {
        self.parents.get(node as usize).copied().flatten()
    }

    /// Returns the node with this index.
    pub fn node(&self, index: u32) -> Option<&TreeNode> {
        self.tree.nodes.get(index as usize)
    }

    /// Returns the nodes with exactly this box, in depth-first order, but at most `MAX_EQUAL` of
    /// them.
    pub fn with_box(&self, min: Vec3, max: Vec3) -> &[u32] {
        let wanted = bits_of(min, max);
        let of = |node: &u32| bits(&self.tree.nodes[*node as usize]);
        let start = self.by_box.partition_point(|node| of(node) < wanted);
        let rest = &self.by_box[start..];
        let rest = &rest[..rest.len().min(MAX_EQUAL)];
        &rest[..rest.partition_point(|node| of(node) == wanted)]
    }

    /// Returns whether a node is reached from the root and has exactly this box.
    pub fn has_box(&self, node: u32, min: Vec3, max: Vec3) -> bool {
        let is_equal = |node: &TreeNode| bits(node) == bits_of(min, max);
        self.level(node).is_some() && self.node(node).is_some_and(is_equal)
    }

    /// Returns the leaf that contains the primitive with this number.
    pub fn leaf_of(&self, number: u32) -> Option<u32> {
        self.leaves.get(&number).copied()
    }

    /// Returns the other child of a node's parent.
    pub fn sibling(&self, node: u32) -> Option<u32> {
        let parent = self.node(self.parent(node)?)?;
        Some(if parent.l == node { parent.r } else { parent.l })
    }

    /// Returns the number of primitives below a node.
    pub fn count(&self, index: u32) -> u32 {
        self.counts.get(index as usize).copied().unwrap_or(0)
    }
}

fn bits(node: &TreeNode) -> [u32; 6] {
    bits_of(node.min, node.max)
}

fn bits_of(min: Vec3, max: Vec3) -> [u32; 6] {
    let [a, b, c] = min.to_array().map(f32::to_bits);
    let [d, e, f] = max.to_array().map(f32::to_bits);
    [a, b, c, d, e, f]
}
