//! A tree's nodes with their places in a drawing by levels.

use crate::drawing_data::{LevelNode, Sweep};
use crate::judge::tree::reached_nodes::ReachedNode;

/// A node, how deep it is, and how many primitives are to the left of it.
#[derive(Clone, Copy)]
pub(super) struct NodePosition<'a> {
    pub(super) cell: &'a ReachedNode<'a>,
    pub(super) level: u32,
    pub(super) start: u32,
}

/// All nodes, the root first.
pub(super) fn positions<'a>(cells: &'a [ReachedNode<'a>]) -> Vec<NodePosition<'a>> {
    let last = cells.iter().map(|cell| cell.index as usize).max();
    let mut by_place = vec![None; last.map_or(0, |last| last + 1)];
    for cell in cells {
        by_place[cell.index as usize] = Some(cell);
    }
    let cell_at = |place: u32| by_place.get(place as usize).copied().flatten();

    let mut placed = Vec::new();
    let mut open: Vec<(&ReachedNode, u32, u32)> =
        cells.first().map(|root| (root, 0, 0)).into_iter().collect();
    while let Some((cell, level, start)) = open.pop() {
        placed.push(NodePosition { cell, level, start });
        if cell.leaf_primitives.is_some() {
            continue;
        }
        if let (Some(left), Some(right)) = (cell_at(cell.node.l), cell_at(cell.node.r)) {
            let middle = start.saturating_add(left.count as u32);
            open.push((right, level + 1, middle));
            open.push((left, level + 1, start));
        }
    }
    placed
}

/// The upper levels, as the exam tells those of the sweep.
pub(super) fn upper_levels(placed: &[NodePosition]) -> Vec<LevelNode> {
    let root = placed
        .first()
        .map_or(f64::NAN, |root| root.cell.tight_bounds.area());
    let upper = placed.iter().filter(|node| node.level < Sweep::LEVELS);
    upper
        .map(|node| {
            let area = node.cell.tight_bounds.area() / root;
            let is_leaf = node.cell.leaf_primitives.is_some();
            let times = if is_leaf { node.cell.count as f64 } else { 1.0 };
            LevelNode {
                level: node.level,
                start: node.start,
                count: node.cell.count as u32,
                is_leaf,
                // A node that holds nothing has no area.
                cost: if area.is_finite() { area * times } else { 0.0 } as f32,
            }
        })
        .collect()
}
