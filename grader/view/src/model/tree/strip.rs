//! The strip that shows a tree level by level.

use serde::Serialize;

use super::TreeModel;

/// The maximum number of levels in the strip. More levels can't be told apart on a screen.
const STRIP_LEVELS: u32 = 256;

/// A bar in the strip that shows the tree level by level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// The node.
    pub node: u32,
    /// Its level.
    pub level: u32,
    /// The share of the primitives that are to the left of the node, from 0 to 1.
    pub start: f32,
    /// The share of the primitives that are below the node.
    pub width: f32,
    /// Whether it is a leaf.
    pub leaf: bool,
}

impl TreeModel {
    /// Returns the bars of the strip. Where bars are narrower than `narrowest`, only one bar is
    /// returned for each stretch of that width, so that there are no more bars than can be seen.
    /// For a very deep tree, only the first levels are returned.
    pub fn strip(&self, narrowest: f32) -> Vec<Bar> {
        let total = self.index.count(self.index.tree.root).max(1) as f32;
        let mut bars = Vec::new();
        let mut starts = vec![0; self.index.tree.nodes.len()];
        // For each level, the right end of the bars so far. The traversal is depth-first, so it
        // visits the nodes of each level from left to right.
        let mut ends = vec![0.0; self.index.levels() as usize];
        for index in self.index.order.iter().copied() {
            let node = &self.index.tree.nodes[index as usize];
            let start = starts[index as usize];
            if !node.is_leaf() {
                for (child, offset) in [(node.l, 0), (node.r, self.index.count(node.l))] {
                    if self.index.parent(child) == Some(index) {
                        starts[child as usize] = u32::saturating_add(start, offset);
                    }
                }
            }
            let level = self.index.level(index).unwrap_or(0);
            if level >= STRIP_LEVELS {
                continue;
            }
            let start = start as f32 / total;
            let width = self.index.count(index) as f32 / total;
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
}
