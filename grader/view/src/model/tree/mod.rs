//! A submission's tree: levels, sizes and costs of its nodes. The tree may be invalid, so nothing
//! here assumes that it is a tree.

mod strip;

use std::collections::HashMap;

use glam::Vec3;
use protocol::{Tree, TreeNode};
use serde::Serialize;

pub use strip::Bar;

/// The maximum number of nodes to list for one box.
const MAX_EQUAL: usize = 100;
/// The maximum number of leaves to read per primitive, on average. More would take too long if all
/// leaves contain all primitives.
const MAX_LEAVES: usize = 64;

/// A tree with facts about its nodes.
#[derive(Clone, Debug)]
pub struct TreeModel {
    /// The tree.
    pub tree: Tree,
    /// The parent of each node. `None` for the root and for nodes that aren't reached from it.
    parents: Vec<Option<u32>>,
    /// The level of each node, 0 for the root. `None` for nodes that aren't reached from it.
    levels: Vec<Option<u32>>,
    /// The number of primitives in the leaves below each node.
    counts: Vec<u32>,
    /// The nodes in depth-first order.
    order: Vec<u32>,
    /// The number of levels.
    depth: u32,
    /// The leaf that contains each primitive, by the primitive's number: the first one in
    /// depth-first order.
    leaves: HashMap<u32, u32>,
    /// The nodes, sorted by the bits of their boxes.
    by_box: Vec<u32>,
}

/// A node as shown on the page.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodeInfo {
    /// Its index in the submission's list of nodes.
    pub node: u32,
    /// Its level, 0 for the root.
    pub level: u32,
    /// Its parent, except for the root.
    pub parent: Option<u32>,
    /// The children of an interior node.
    pub children: Option<[u32; 2]>,
    /// The lower corner of its box.
    pub min: Vec3,
    /// The upper corner of its box.
    pub max: Vec3,
    /// Whether it is a leaf.
    pub leaf: bool,
    /// The number of primitives below it.
    pub primitives: u32,
    /// The area of its box as a share of the root's, i.e. the probability that a ray that hits the
    /// root's box also hits this one.
    pub area: f32,
    /// Its own contribution to the expected number of tests for a ray that hits the root's box.
    pub cost: f32,
    /// In an interior node, the expected number of children hit by a ray that hits this node's box:
    /// less than 1 if the children leave much of the box empty, 2 if both fill it.
    pub overlap: Option<f32>,
}

impl TreeModel {
    /// Computes the facts about a tree in time `n log n`, no matter what its nodes refer to.
    pub fn new(tree: Tree) -> Self {
        let nodes = tree.nodes.len();
        let mut model = TreeModel {
            parents: vec![None; nodes],
            levels: vec![None; nodes],
            counts: vec![0; nodes],
            order: Vec::new(),
            depth: 0,
            leaves: HashMap::new(),
            by_box: Vec::new(),
            tree,
        };
        model.visit();
        model.by_box.clone_from(&model.order);
        let nodes = &model.tree.nodes;
        model
            .by_box
            .sort_by_key(|node| bits(&nodes[*node as usize]));
        model
    }

    /// Visits each node that can be reached from the root once and fills in the lists.
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

    /// Returns the nodes whose boxes are exactly this one, in depth-first order. If there are very
    /// many, only the first are returned.
    pub fn with_box(&self, min: Vec3, max: Vec3) -> &[u32] {
        let wanted = bits_of(min, max);
        let of = |node: &u32| bits(&self.tree.nodes[*node as usize]);
        let start = self.by_box.partition_point(|node| of(node) < wanted);
        let rest = &self.by_box[start..];
        let rest = &rest[..rest.len().min(MAX_EQUAL)];
        &rest[..rest.partition_point(|node| of(node) == wanted)]
    }

    /// Returns whether a node is reached from the root and its box is exactly this one.
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

    /// Returns the information about a node for the page.
    pub fn info(&self, index: u32) -> Option<NodeInfo> {
        let node = self.node(index)?;
        let (leaf, primitives) = (node.is_leaf(), self.count(index));
        let area = self.area_share(index);
        let children = (!leaf).then_some([node.l, node.r]);
        let in_children = |children: [u32; 2]| -> f32 {
            children
                .into_iter()
                .map(|child| self.area_share(child))
                .sum()
        };
        Some(NodeInfo {
            node: index,
            level: self.level(index)?,
            parent: self.parent(index),
            children,
            min: node.min,
            max: node.max,
            leaf,
            primitives,
            area,
            cost: area * if leaf { primitives as f32 } else { 1.0 },
            overlap: children.map(|both| in_children(both) / area.max(f32::MIN_POSITIVE)),
        })
    }

    /// Returns the expected number of tests for a ray that hits the root's box, if a step down and
    /// a primitive each cost one.
    pub fn cost(&self) -> f32 {
        self.order
            .iter()
            .filter_map(|node| self.info(*node))
            .map(|info| info.cost)
            .sum()
    }

    /// Returns the nodes of one level or, with `below`, of all levels from it down. Those with the
    /// largest boxes come first, and at most `most` are returned. Also returns the total number.
    pub fn at_level(&self, level: u32, below: bool, most: usize) -> (Vec<NodeInfo>, usize) {
        let is_shown = |node: &&u32| match self.level(**node) {
            Some(of_node) if below => of_node >= level,
            Some(of_node) => of_node == level,
            None => false,
        };
        self.largest(self.order.iter().filter(is_shown), most, |node| node.area)
    }

    /// Returns the nodes with the highest costs, except the root.
    pub fn worst(&self, most: usize) -> Vec<NodeInfo> {
        let below_root = self.order.iter().skip(1);
        self.largest(below_root, most, |node| node.cost).0
    }

    /// Returns the nodes with the largest values and the total number.
    fn largest<'a>(
        &self,
        nodes: impl Iterator<Item = &'a u32>,
        most: usize,
        value: impl Fn(&NodeInfo) -> f32,
    ) -> (Vec<NodeInfo>, usize) {
        let valued = nodes.filter_map(|node| Some((value(&self.info(*node)?), *node)));
        let mut valued: Vec<(f32, u32)> = valued.collect();
        valued.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let nodes = valued.iter().take(most);
        let nodes = nodes.filter_map(|(_, node)| self.info(*node)).collect();
        (nodes, valued.len())
    }

    /// Returns the number of primitives below a node.
    pub fn count(&self, index: u32) -> u32 {
        self.counts.get(index as usize).copied().unwrap_or(0)
    }

    fn area_share(&self, index: u32) -> f32 {
        let area = |node: &TreeNode| {
            let size = (node.max - node.min).max(Vec3::ZERO);
            size.x * size.y + size.y * size.z + size.z * size.x
        };
        let of_root = self.node(self.tree.root).map_or(0.0, area);
        let of_node = self.node(index).map_or(0.0, area);
        if of_root > 0.0 {
            of_node / of_root
        } else {
            1.0
        }
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

#[cfg(test)]
mod tests;
