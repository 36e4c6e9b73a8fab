//! The strip that shows a tree by levels.

use serde::Serialize;

use super::TreeModel;

/// The number of levels in the strip. More levels can't be told apart on a screen.
const STRIP_LEVELS: u32 = 256;

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
    /// Returns the bars of the strip. If bars are narrower than `narrowest`, only one is returned
    /// per that width, so that there are no more than can be seen. For a very deep tree, only the
    /// first levels are returned.
    pub fn strip(&self, narrowest: f32) -> Vec<Bar> {
        let total = self.count(self.tree.root).max(1) as f32;
        let mut bars = Vec::new();
        let mut starts = vec![0; self.tree.nodes.len()];
        // The right ends of each level's bars so far. The traversal is depth-first, so it goes from
        // left to right in each level.
        let mut ends = vec![0.0; self.levels() as usize];
        for index in self.order.iter().copied() {
            let node = &self.tree.nodes[index as usize];
            let start = starts[index as usize];
            if !node.is_leaf() {
                for (child, offset) in [(node.l, 0), (node.r, self.count(node.l))] {
                    if self.parent(child) == Some(index) {
                        starts[child as usize] = u32::saturating_add(start, offset);
                    }
                }
            }
            let level = self.levels[index as usize].unwrap_or(0);
            if level >= STRIP_LEVELS {
                continue;
            }
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
}
