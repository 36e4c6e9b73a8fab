//! A submission's tree: levels, sizes and costs of its nodes. The tree may be invalid, so nothing
//! here assumes that it is a tree.

use std::collections::HashMap;

use glam::Vec3;
use protocol::{Tree, TreeNode};
use serde::Serialize;

/// A tree with facts about its nodes.
#[derive(Clone, Debug)]
pub struct TreeModel {
    /// The tree.
    pub tree: Tree,
    /// The parent of each node; `None` for the root and for nodes that are not reached from it.
    parents: Vec<Option<u32>>,
    /// The level of each node, 0 for the root; `None` for nodes that are not reached from it.
    levels: Vec<Option<u32>>,
    /// The number of primitives in the leaves below each node.
    counts: Vec<u32>,
    /// The nodes in depth-first order.
    order: Vec<u32>,
    /// The leaf that holds the primitive at each index.
    leaves: Vec<Option<u32>>,
    by_bits: HashMap<[u32; 6], Vec<u32>>,
}

/// A node as it is shown on the page.
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
    pub min: [f32; 3],
    /// The upper corner of its box.
    pub max: [f32; 3],
    /// Whether it is a leaf.
    pub leaf: bool,
    /// The number of primitives below it.
    pub primitives: u32,
    /// The area of its box as a share of the root's: the probability that a ray that hits the root's
    /// box hits this one.
    pub area: f32,
    /// Its own part of the expected number of tests of a ray that hits the root's box.
    pub cost: f32,
    /// In an interior node, the expected number of children whose boxes a ray hits that hits this
    /// one: less than 1 if they leave much of it empty, 2 if both fill it.
    pub overlap: Option<f32>,
}

/// A bar of the strip that shows the tree by levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// The node.
    pub node: u32,
    /// Its level.
    pub level: u32,
    /// The share of primitives to its left, from 0 to 1.
    pub start: f32,
    /// Its share of primitives.
    pub width: f32,
    /// Whether it is a leaf.
    pub leaf: bool,
}

impl TreeModel {
    /// Computes the facts about a tree.
    pub fn new(tree: Tree) -> Self {
        let nodes = tree.nodes.len();
        let mut model = TreeModel {
            parents: vec![None; nodes],
            levels: vec![None; nodes],
            counts: vec![0; nodes],
            order: Vec::new(),
            leaves: vec![None; tree.order.len()],
            by_bits: HashMap::new(),
            tree,
        };
        model.visit();
        for index in &model.order {
            let node = &model.tree.nodes[*index as usize];
            model
                .by_bits
                .entry(bits(node.min, node.max))
                .or_default()
                .push(*index);
        }
        model
    }

    /// Visits each node that can be reached from the root once, and fills in the lists.
    fn visit(&mut self) {
        let mut stack = vec![(self.tree.root, None, 0)];
        while let Some((index, parent, level)) = stack.pop() {
            let Some(node) = self.tree.nodes.get(index as usize).copied() else {
                continue;
            };
            let slot = &mut self.levels[index as usize];
            // A node that has been visited has another parent, too, or the tree has a cycle.
            if slot.is_some() {
                continue;
            }
            *slot = Some(level);
            self.parents[index as usize] = parent;
            self.order.push(index);
            if node.is_leaf() {
                let first = node.start as usize;
                let held = self.leaves.iter_mut().skip(first).take(node.size as usize);
                let mut count = 0;
                for leaf in held {
                    leaf.get_or_insert(index);
                    count += 1;
                }
                self.counts[index as usize] = count;
            } else {
                stack.push((node.r, Some(index), level + 1));
                stack.push((node.l, Some(index), level + 1));
            }
        }
        for index in self.order.iter().rev() {
            let count = self.counts[*index as usize];
            if let Some(parent) = self.parents[*index as usize] {
                self.counts[parent as usize] += count;
            }
        }
    }

    /// Returns whether there is a node.
    pub fn has_nodes(&self) -> bool {
        !self.order.is_empty()
    }

    /// Returns the number of levels.
    pub fn levels(&self) -> u32 {
        let levels = self
            .order
            .iter()
            .filter_map(|node| self.levels[*node as usize]);
        levels.max().map_or(0, |deepest| deepest + 1)
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

    /// Returns the nodes whose boxes are exactly this one, in depth-first order.
    pub fn with_box(&self, min: Vec3, max: Vec3) -> &[u32] {
        self.by_bits.get(&bits(min, max)).map_or(&[], Vec::as_slice)
    }

    /// Returns the leaf that holds each primitive, by the number in its material.
    pub fn leaves_by_number(&self) -> HashMap<u32, u32> {
        let pairs = self.tree.order.iter().zip(&self.leaves);
        pairs
            .filter_map(|(number, leaf)| Some((*number, (*leaf)?)))
            .collect()
    }

    /// Returns what the page shows of a node.
    pub fn info(&self, index: u32) -> Option<NodeInfo> {
        let node = self.node(index)?;
        let area = self.area_share(index);
        let children = (!node.is_leaf()).then(|| self.area_share(node.l) + self.area_share(node.r));
        Some(NodeInfo {
            node: index,
            level: self.level(index)?,
            parent: self.parent(index),
            children: (!node.is_leaf()).then_some([node.l, node.r]),
            min: node.min.to_array(),
            max: node.max.to_array(),
            leaf: node.is_leaf(),
            primitives: self.counts[index as usize],
            area,
            cost: area
                * if node.is_leaf() {
                    self.counts[index as usize] as f32
                } else {
                    1.0
                },
            overlap: children.map(|children| children / area.max(f32::MIN_POSITIVE)),
        })
    }

    /// Returns the expected number of tests of a ray that hits the root's box, when a step down and
    /// a primitive cost one each.
    pub fn cost(&self) -> f32 {
        self.order
            .iter()
            .filter_map(|node| self.info(*node))
            .map(|info| info.cost)
            .sum()
    }

    /// Returns the nodes of one level, or, with `below`, of all levels from it down; those with the
    /// largest boxes first, and at most `most` of them. Also returns the number of all.
    pub fn at_level(&self, level: u32, below: bool, most: usize) -> (Vec<NodeInfo>, usize) {
        let is_shown = |node: &&u32| match self.level(**node) {
            Some(of_node) if below => of_node >= level,
            Some(of_node) => of_node == level,
            None => false,
        };
        let nodes = self.order.iter().filter(is_shown);
        let mut nodes: Vec<NodeInfo> = nodes.filter_map(|node| self.info(*node)).collect();
        let count = nodes.len();
        nodes.sort_by(|a, b| b.area.total_cmp(&a.area));
        nodes.truncate(most);
        (nodes, count)
    }

    /// Returns the nodes with the highest costs, except the root.
    pub fn worst(&self, most: usize) -> Vec<NodeInfo> {
        let below_root = self.order.iter().skip(1);
        let mut nodes: Vec<NodeInfo> = below_root.filter_map(|node| self.info(*node)).collect();
        nodes.sort_by(|a, b| b.cost.total_cmp(&a.cost));
        nodes.truncate(most);
        nodes
    }

    /// Returns the bars of the strip. Of the bars that are narrower than `narrowest`, one is returned
    /// for each such width, so that there are not more than can be seen.
    pub fn strip(&self, narrowest: f32) -> Vec<Bar> {
        let total = self
            .counts
            .get(self.tree.root as usize)
            .copied()
            .unwrap_or(0)
            .max(1) as f32;
        let mut bars = Vec::new();
        let mut starts = vec![0; self.tree.nodes.len()];
        // The right ends of each level's bars so far. The order is depth-first, so it is from left to
        // right in each level.
        let mut ends = vec![0.0; self.levels() as usize];
        for index in self.order.iter().copied() {
            let node = &self.tree.nodes[index as usize];
            let start = starts[index as usize];
            if !node.is_leaf() {
                for (child, offset) in [(node.l, 0), (node.r, self.count(node.l))] {
                    if self.parent(child) == Some(index) {
                        starts[child as usize] = start + offset;
                    }
                }
            }
            let level = self.levels[index as usize].unwrap_or(0);
            let start = start as f32 / total;
            let width = self.count(index) as f32 / total;
            let end = &mut ends[level as usize];
            if width >= narrowest || start >= *end {
                *end = start + width.max(narrowest);
                bars.push(Bar {
                    node: index,
                    level,
                    start,
                    width,
                    leaf: node.is_leaf(),
                });
            }
        }
        bars
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

fn bits(min: Vec3, max: Vec3) -> [u32; 6] {
    let [a, b, c] = min.to_array().map(f32::to_bits);
    let [d, e, f] = max.to_array().map(f32::to_bits);
    [a, b, c, d, e, f]
}

#[cfg(test)]
mod tests;
