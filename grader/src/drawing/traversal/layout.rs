//! Chooses the nodes of a traversal to draw, and determines the status of each.

use std::collections::BTreeMap;

use protocol::{Interval, TreeNode};

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
    /// The row stands for several omitted rows; its `node` is their number.
    Elided,
}

impl NodeStatus {
    /// Returns whether a correct traversal tests the node's box but does not enter the node.
    pub(super) fn is_skipped(self) -> bool {
        match self {
            NodeStatus::Missed | NodeStatus::OutOfRange | NodeStatus::Beyond => true,
            NodeStatus::Entered | NodeStatus::Elided => false,
        }
    }
}

/// A row of the diagram. It shows one node or stands for several omitted ones.
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
    pub(super) fn new(comparison: &HitComparison, traversal: &RecordedTraversal) -> Layout {
        let parents = ParentMap::new(traversal);
        let leaf_with = |shape: Option<u32>| parents.leaf_with(traversal, shape?);
        let wanted = leaf_with(comparison.wanted.and_then(|hit| hit.shape));
        let got = leaf_with(comparison.got.hit().and_then(|hit| hit.shape));
        let paths =
            [wanted, got].map(|leaf| leaf.map_or(Vec::new(), |leaf| parents.path_to_root(leaf)));

        let mut number = 0;
        let rows: Vec<NodeRow> = traversal
            .steps
            .iter()
            .map(|step| {
                number += usize::from(step.is_entered);
                let node = traversal.nodes.get(step.node as usize);
                NodeRow {
                    node: step.node,
                    number,
                    depth: parents.depth(step.node),
                    is_leaf: node.is_some_and(TreeNode::is_leaf),
                    status: node_status(step.is_entered, step.span, comparison),
                    span: step.span.filter(|span| !span.is_empty()),
                }
            })
            .collect();
        let matters = |row: &NodeRow| {
            let parent = parents.parent(row.node);
            let of = |node: u32| paths.iter().any(|path| path.contains(&node));
            (of(row.node), parent.is_some_and(of))
        };
        let [_, path_to_got] = paths.clone();
        Layout {
            rows: shorten(&rows, matters),
            wanted_leaf: wanted,
            got_leaf: got,
            path_to_got,
        }
    }

    /// Returns the deepest row on the path to the submitted hit's leaf: the node at which a correct
    /// traversal leaves the path, or the leaf itself.
    pub(super) fn got_row(&self) -> Option<&NodeRow> {
        let on_path = self.rows.iter().filter(|row| {
            let is_node = row.status != NodeStatus::Elided;
            is_node && self.path_to_got.contains(&row.node)
        });
        on_path.max_by_key(|row| row.depth)
    }

    /// Returns the row of a node that a correct traversal skips, if the submitted hit is below it.
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

/// Chooses at most [`MAX_ROWS`] rows: first those on the path to a relevant leaf, then the children
/// of nodes on such a path, then the others in order. Each run of omitted rows becomes a single
/// row.
fn shorten(rows: &[NodeRow], matters: impl Fn(&NodeRow) -> (bool, bool)) -> Vec<NodeRow> {
    let mut ranks: Vec<(usize, usize)> = rows
        .iter()
        .enumerate()
        .map(|(index, row)| match matters(row) {
            (true, _) => (0, index),
            (false, true) => (1, index),
            (false, false) => (2, index),
        })
        .collect();
    // The end of a long path matters most.
    ranks.sort_by_key(|&(rank, index)| match rank {
        0 => (0, rows.len() - index),
        _ => (rank, index),
    });
    let mut is_kept = vec![false; rows.len()];
    for (_, index) in ranks.into_iter().take(MAX_ROWS) {
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

/// The parent of each node that can be reached from the root. The root has none.
struct ParentMap(BTreeMap<u32, Option<u32>>);

impl ParentMap {
    fn new(traversal: &RecordedTraversal) -> ParentMap {
        let mut parents = BTreeMap::new();
        let mut open = vec![(traversal.root, None)];
        while let Some((index, parent)) = open.pop() {
            let Some(node) = traversal.nodes.get(index as usize) else {
                continue;
            };
            // A node that was reached before is shared or closes a cycle: do not follow it again.
            if parents.contains_key(&index) {
                continue;
            }
            parents.insert(index, parent);
            if !node.is_leaf() {
                open.extend([(node.l, Some(index)), (node.r, Some(index))]);
            }
        }
        ParentMap(parents)
    }

    fn parent(&self, node: u32) -> Option<u32> {
        self.0.get(&node).copied().flatten()
    }

    /// Returns the nodes from `node` up to the root, both included.
    fn path_to_root(&self, node: u32) -> Vec<u32> {
        std::iter::successors(Some(node), |node| self.parent(*node)).collect()
    }

    fn depth(&self, node: u32) -> usize {
        self.path_to_root(node).len() - 1
    }

    /// Returns the leaf that contains the first primitive with this number.
    fn leaf_with(&self, traversal: &RecordedTraversal, number: u32) -> Option<u32> {
        let mut shapes = traversal.shapes.iter();
        let index = shapes.position(|shape| shape.number() == number)? as u64;
        let holds = |node: &&u32| {
            let node = &traversal.nodes[**node as usize];
            let start = u64::from(node.start);
            node.is_leaf() && (start..start + u64::from(node.size)).contains(&index)
        };
        self.0.keys().find(holds).copied()
    }
}
