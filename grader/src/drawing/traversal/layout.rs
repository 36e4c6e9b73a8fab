//! Chooses which nodes of a traversal to draw and determines the status of each.

use std::collections::BTreeMap;

use judging::judge::tree::reached_nodes::{ReachedNode, reached_nodes};
use protocol::{Interval, Shape, Tree};

use super::RecordedTraversal;
use crate::drawing::hit_comparison::HitComparison;

/// The maximum number of rows.
const MAX_ROWS: usize = 28;

/// The status of a node in a correct traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeStatus {
    /// The node is entered.
    Entered,
    /// The ray misses the box.
    Missed,
    /// The ray hits the box, but only outside the ray's range.
    OutOfRange,
    /// The ray enters the box only beyond the closest hit so far.
    Beyond,
    /// The row stands for several omitted rows. Its `node` is the number of omitted rows.
    Elided,
}

impl NodeStatus {
    /// Returns whether a correct traversal tests the node's box but doesn't enter the node.
    pub(super) fn is_skipped(self) -> bool {
        match self {
            NodeStatus::Missed | NodeStatus::OutOfRange | NodeStatus::Beyond => true,
            NodeStatus::Entered | NodeStatus::Elided => false,
        }
    }
}

/// A row of the diagram, which either shows one node or stands for several omitted rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeRow {
    pub(super) node: u32,
    /// The position of the node among the entered nodes, counted from 1.
    pub(super) number: usize,
    pub(super) depth: usize,
    pub(super) is_leaf: bool,
    pub(super) status: NodeStatus,
    pub(super) span: Option<Interval>,
}

/// The rows to draw, and the leaves of the expected and the submitted hit.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) rows: Vec<NodeRow>,
    /// The leaf of the expected hit.
    pub(super) wanted_leaf: Option<u32>,
    /// The leaf of the submitted hit.
    pub(super) got_leaf: Option<u32>,
    /// The nodes from the leaf of the submitted hit up to the root.
    path_to_got: Vec<u32>,
}

impl Layout {
    /// Returns the layout of a traversal, or `None` if its nodes don't form a tree.
    pub(super) fn new(comparison: &HitComparison, traversal: &RecordedTraversal) -> Option<Layout> {
        let tree = Tree {
            nodes: traversal.nodes.to_vec(),
            root: traversal.root,
            order: traversal.shapes.iter().map(Shape::number).collect(),
        };
        let nodes = reached_nodes(traversal.shapes, &tree).ok()?;
        let by_index: BTreeMap<u32, &ReachedNode> =
            nodes.iter().map(|node| (node.index, node)).collect();
        let interior = nodes.iter().filter(|node| node.leaf_primitives.is_none());
        let children =
            interior.flat_map(|node| [(node.node.l, node.index), (node.node.r, node.index)]);
        let parents: BTreeMap<u32, u32> = children.collect();
        let path_to_root = |node: u32| -> Vec<u32> {
            std::iter::successors(Some(node), |node| parents.get(node).copied()).collect()
        };
        let leaf_with = |number: Option<u32>| {
            let mut shapes = traversal.shapes.iter();
            let index = shapes.position(|shape| Some(shape.number()) == number)?;
            let holds =
                |node: &&ReachedNode| node.leaf_primitives.iter().flatten().any(|i| *i == index);
            nodes.iter().find(holds).map(|leaf| leaf.index)
        };
        let wanted = leaf_with(comparison.wanted.map(|hit| hit.shape));
        let got = leaf_with(comparison.got_hit().map(|hit| hit.shape));
        let [path_to_wanted, path_to_got] =
            [wanted, got].map(|leaf| leaf.map_or(Vec::new(), path_to_root));

        let mut number = 0;
        let steps = traversal.steps.iter().map(|step| {
            number += usize::from(step.is_entered);
            let node = by_index.get(&step.node)?;
            Some(NodeRow {
                node: step.node,
                number,
                depth: node.level as usize,
                is_leaf: node.leaf_primitives.is_some(),
                status: node_status(step.is_entered, step.span, comparison),
                span: step.span.filter(|span| !span.is_empty()),
            })
        });
        let rows = steps.collect::<Option<Vec<NodeRow>>>()?;
        let of = |node: u32| path_to_wanted.contains(&node) || path_to_got.contains(&node);
        let matters = |row: &NodeRow| {
            let parent = parents.get(&row.node);
            (of(row.node), parent.is_some_and(|parent| of(*parent)))
        };
        Some(Layout {
            rows: shorten(&rows, matters),
            wanted_leaf: wanted,
            got_leaf: got,
            path_to_got,
        })
    }

    /// Returns the row of the deepest node on the path to the submitted hit's leaf: either the node
    /// where a correct traversal leaves the path, or the leaf itself.
    pub(super) fn got_row(&self) -> Option<&NodeRow> {
        let on_path = self.rows.iter().filter(|row| {
            let is_node = row.status != NodeStatus::Elided;
            is_node && self.path_to_got.contains(&row.node)
        });
        on_path.max_by_key(|row| row.depth)
    }

    /// If the submitted hit is below a node that a correct traversal skips, returns that node's
    /// row.
    pub(super) fn decoy(&self) -> Option<&NodeRow> {
        self.got_row().filter(|row| row.status.is_skipped())
    }

    /// Returns the position of the expected hit's leaf among the entered nodes.
    pub(super) fn wanted_leaf_number(&self) -> Option<usize> {
        let is_it = |row: &&NodeRow| {
            row.status == NodeStatus::Entered && Some(row.node) == self.wanted_leaf
        };
        self.rows.iter().find(is_it).map(|row| row.number)
    }
}

fn node_status(is_entered: bool, span: Option<Interval>, comparison: &HitComparison) -> NodeStatus {
    let range = comparison.ray.range;
    match span {
        _ if is_entered => NodeStatus::Entered,
        None => NodeStatus::Missed,
        Some(span) if span.max < range.min || span.min > range.max => NodeStatus::OutOfRange,
        Some(_) => NodeStatus::Beyond,
    }
}

/// Chooses at most [`MAX_ROWS`] rows: first the nodes on the path to a relevant leaf, then the
/// children of nodes on such a path, then the remaining nodes in order. Each run of omitted rows
/// becomes a single row.
fn shorten(rows: &[NodeRow], matters: impl Fn(&NodeRow) -> (bool, bool)) -> Vec<NodeRow> {
    // The end of a long path matters most.
    let rank = |index: usize| match matters(&rows[index]) {
        (true, _) => (0, rows.len() - index),
        (false, true) => (1, index),
        (false, false) => (2, index),
    };
    let mut by_rank: Vec<usize> = (0..rows.len()).collect();
    by_rank.sort_by_key(|index| rank(*index));
    let mut is_kept = vec![false; rows.len()];
    for index in by_rank.into_iter().take(MAX_ROWS) {
        is_kept[index] = true;
    }
    let mut shown: Vec<NodeRow> = Vec::new();
    for (row, is_kept) in rows.iter().zip(is_kept) {
        match shown.last_mut() {
            _ if is_kept => shown.push(*row),
            Some(last) if last.status == NodeStatus::Elided => last.node += 1,
            Some(_) | None => shown.push(NodeRow {
                node: 1,
                status: NodeStatus::Elided,
                span: None,
                ..*row
            }),
        }
    }
    shown
}
