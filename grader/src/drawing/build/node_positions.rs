//! Lays out the nodes of a tree for a drawing with one row per level.

use judging::drawing_data::{LevelNode, Sweep};
use judging::judge::tree::reached_nodes::ReachedNode;

/// A node, its depth, and the number of primitives to the left of it.
#[derive(Clone, Copy)]
pub(super) struct NodePosition<'a> {
    pub(super) reached: &'a ReachedNode<'a>,
    pub(super) level: u32,
    pub(super) start: u32,
}

/// Returns the positions of all nodes, the root first.
pub(super) fn positions<'a>(nodes: &'a [ReachedNode<'a>]) -> Vec<NodePosition<'a>> {
    let last = nodes.iter().map(|reached| reached.index as usize).max();
    let mut by_index = vec![None; last.map_or(0, |last| last + 1)];
    for reached in nodes {
        by_index[reached.index as usize] = Some(reached);
    }
    let reached_at = |index: u32| by_index.get(index as usize).copied().flatten();

    let mut positions = Vec::new();
    let mut open: Vec<(&ReachedNode, u32, u32)> =
        nodes.first().map(|root| (root, 0, 0)).into_iter().collect();
    while let Some((reached, level, start)) = open.pop() {
        positions.push(NodePosition {
            reached,
            level,
            start,
        });
        if reached.leaf_primitives.is_some() {
            continue;
        }
        if let (Some(left), Some(right)) = (reached_at(reached.node.l), reached_at(reached.node.r))
        {
            let middle = start.saturating_add(left.count as u32);
            open.push((right, level + 1, middle));
            open.push((left, level + 1, start));
        }
    }
    positions
}

/// Returns the upper levels of a tree, in the form in which the exam stores the exact sweep's tree.
pub(super) fn upper_levels(positions: &[NodePosition]) -> Vec<LevelNode> {
    let root = positions
        .first()
        .map_or(f64::NAN, |root| root.reached.tight_bounds.area());
    let upper = positions.iter().filter(|node| node.level < Sweep::LEVELS);
    upper
        .map(|node| {
            let area = node.reached.tight_bounds.area() / root;
            let is_leaf = node.reached.leaf_primitives.is_some();
            let times = if is_leaf {
                node.reached.count as f64
            } else {
                1.0
            };
            LevelNode {
                level: node.level,
                start: node.start,
                count: node.reached.count as u32,
                is_leaf,
                // The area of an empty node is not finite.
                cost: if area.is_finite() { area * times } else { 0.0 } as f32,
            }
        })
        .collect()
}
