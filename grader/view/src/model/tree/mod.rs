//! A submission's tree: levels, sizes and costs of its nodes. The tree may be invalid, so nothing
//! here assumes that the nodes really form a tree.

mod checkup;
mod strip;

use glam::Vec3;
use judging::judge::tree::TreeCriteria;
use judging::judge::tree::reached_nodes::reached_nodes;
use protocol::TreeNode;
use serde::Serialize;
use view_probe::indexed_tree::IndexedTree;

pub use checkup::{CHECKS, TreeCheckup};
pub use strip::Bar;

/// A tree with facts about its nodes.
#[derive(Clone, Debug, Default)]
pub struct TreeModel {
    /// The tree.
    pub index: IndexedTree,
    /// The defects of the tree, and its cost.
    pub checkup: TreeCheckup,
    /// Each node's contribution to the SAH cost, as the judge computes it. It is 0 for nodes
    /// without primitives and for nodes that aren't reached from the root, and 0 for all nodes if
    /// they don't form a tree.
    costs: Vec<f32>,
}

/// A node as shown on the page.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodeInfo {
    /// Its index in the submission's list of nodes.
    pub node: u32,
    /// Its level, 0 for the root.
    pub level: u32,
    /// Its parent, or `None` for the root.
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
    /// The area of its box divided by that of the root's box, i.e. the probability that a ray that
    /// hits the root's box also hits this box.
    pub area: f32,
    /// The node's own contribution to the expected number of tests for a ray that hits the root's
    /// box.
    pub cost: f32,
    /// For an interior node, the expected number of children hit by a ray that hits this node's
    /// box: less than 1 if the children leave much of the box empty, 2 if both fill it.
    pub overlap: Option<f32>,
}

impl TreeModel {
    /// Checks a tree and computes the facts about its nodes.
    pub fn new(index: IndexedTree, criteria: &TreeCriteria) -> Self {
        let mut costs = vec![0.0; index.tree.nodes.len()];
        let reached = reached_nodes(criteria.shapes, &index.tree);
        let nodes = reached.as_deref().unwrap_or_default();
        if let Some(root) = nodes.first() {
            let of_root = root.tight_bounds.area().max(f64::MIN_POSITIVE);
            for node in nodes {
                costs[node.index as usize] = (node.cost() / of_root) as f32;
            }
        }
        TreeModel {
            checkup: TreeCheckup::new(reached, criteria),
            index,
            costs,
        }
    }

    /// Returns the information about a node for the page.
    pub fn info(&self, index: u32) -> Option<NodeInfo> {
        let node = self.index.node(index)?;
        let (leaf, primitives) = (node.is_leaf(), self.index.count(index));
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
            level: self.index.level(index)?,
            parent: self.index.parent(index),
            children,
            min: node.min,
            max: node.max,
            leaf,
            primitives,
            area,
            cost: self.costs[index as usize],
            overlap: children.map(|both| in_children(both) / area.max(f32::MIN_POSITIVE)),
        })
    }

    /// Returns the sum of all nodes' costs: the expected number of tests for a ray that hits the
    /// root's box, if each step down the tree and each test of a primitive costs 1. If primitives
    /// are missing, the sum is too low.
    pub fn total_cost(&self) -> f32 {
        self.costs.iter().sum()
    }

    /// Returns the nodes at this level or, if `below` is true, at this level and all levels below
    /// it. The nodes with the largest boxes come first, and at most `most` nodes are returned. Also
    /// returns the total number of nodes at these levels.
    pub fn at_level(&self, level: u32, below: bool, most: usize) -> (Vec<NodeInfo>, usize) {
        let is_shown = |node: &&u32| match self.index.level(**node) {
            Some(of_node) if below => of_node >= level,
            Some(of_node) => of_node == level,
            None => false,
        };
        self.largest(self.index.order.iter().filter(is_shown), most, |node| {
            node.area
        })
    }

    /// Returns the nodes with the highest costs, except the root.
    pub fn worst(&self, most: usize) -> Vec<NodeInfo> {
        let below_root = self.index.order.iter().skip(1);
        self.largest(below_root, most, |node| node.cost).0
    }

    /// Returns the `most` nodes with the largest values, and the total number of nodes.
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

    fn area_share(&self, index: u32) -> f32 {
        let area = |node: &TreeNode| {
            let size = (node.max - node.min).max(Vec3::ZERO);
            size.x * size.y + size.y * size.z + size.z * size.x
        };
        let of_root = self.index.node(self.index.tree.root).map_or(0.0, area);
        let of_node = self.index.node(index).map_or(0.0, area);
        if of_root > 0.0 {
            of_node / of_root
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests;
