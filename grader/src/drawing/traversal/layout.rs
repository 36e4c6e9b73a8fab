//! What is drawn of a walk: which nodes, and what became of each.

use std::collections::BTreeMap;

use protocol::{Interval, TreeNode};

use super::RecordedTraversal;
use crate::drawing::hit_comparison::{HitAnswer, HitComparison};

/// The most rows.
const MAX_ROWS: usize = 28;

/// What became of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeStatus {
    /// It was entered.
    Entered,
    /// The ray misses its box.
    Missed,
    /// The ray is in its box outside of its range only.
    OutOfRange,
    /// It begins beyond the closest hit so far.
    Beyond,
    /// So many rows are left out here: what stands for the node is their number.
    Elided,
}

impl NodeStatus {
    /// Whether a right walk came to the node, and did not enter it.
    pub(super) fn is_skipped(self) -> bool {
        match self {
            NodeStatus::Missed | NodeStatus::OutOfRange | NodeStatus::Beyond => true,
            NodeStatus::Entered | NodeStatus::Elided => false,
        }
    }
}

/// A node, or nodes that are left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeRow {
    pub(super) node: u32,
    /// Which of those that are entered it is, from 1.
    pub(super) number: usize,
    pub(super) depth: usize,
    pub(super) is_leaf: bool,
    pub(super) status: NodeStatus,
    pub(super) span: Option<Interval>,
}

/// All that is drawn.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) rows: Vec<NodeRow>,
    /// The leaf with what is hit.
    pub(super) wanted_leaf: Option<u32>,
    /// The leaf with what the answer names.
    pub(super) got_leaf: Option<u32>,
    /// The nodes from the root down to that leaf.
    path_to_got: Vec<u32>,
}

impl Layout {
    pub(super) fn new(encounter: &HitComparison, walked: &RecordedTraversal) -> Layout {
        let family = ParentMap::new(walked);
        let leaf_with = |material: Option<u32>| family.leaf_with(walked, material?);
        let wanted = leaf_with(encounter.wanted.and_then(|met| met.material));
        let got = match encounter.got {
            HitAnswer::Hit(met) => leaf_with(met.material),
            HitAnswer::Miss | HitAnswer::NoAnswer => None,
        };
        let ways =
            [wanted, got].map(|leaf| leaf.map_or(Vec::new(), |leaf| family.path_to_root(leaf)));

        let mut number = 0;
        let rows: Vec<NodeRow> = walked
            .steps
            .iter()
            .map(|step| {
                number += usize::from(step.is_entered);
                let node = walked.nodes.get(step.node as usize);
                NodeRow {
                    node: step.node,
                    number,
                    depth: family.depth(step.node),
                    is_leaf: node.is_some_and(TreeNode::is_leaf),
                    status: node_status(step.is_entered, step.span, encounter),
                    span: step.span.filter(|span| !span.is_empty()),
                }
            })
            .collect();
        let matters = |row: &NodeRow| {
            let parent = family.parent(row.node);
            let of = |node: u32| ways.iter().any(|way| way.contains(&node));
            (of(row.node), parent.is_some_and(of))
        };
        let [_, way_to_got] = ways.clone();
        Layout {
            rows: shorten(&rows, matters),
            wanted_leaf: wanted,
            got_leaf: got,
            path_to_got: way_to_got,
        }
    }

    /// The row on the way to the answer's leaf at which a right walk turns away; or the leaf's own.
    pub(super) fn got_row(&self) -> Option<&NodeRow> {
        let on_way = self.rows.iter().filter(|row| {
            let is_node = row.status != NodeStatus::Elided;
            is_node && self.path_to_got.contains(&row.node)
        });
        on_way.max_by_key(|row| row.depth)
    }

    /// Where the answer comes from a leaf that no right walk enters: the row that leads there.
    pub(super) fn decoy(&self) -> Option<&NodeRow> {
        self.got_row().filter(|row| row.status.is_skipped())
    }

    /// Which of the entered nodes is the leaf with what is hit.
    pub(super) fn wanted_leaf_number(&self) -> Option<usize> {
        let is_it = |row: &&NodeRow| {
            row.status == NodeStatus::Entered && Some(row.node) == self.wanted_leaf
        };
        self.rows.iter().find(is_it).map(|row| row.number)
    }
}

fn node_status(is_entered: bool, span: Option<Interval>, encounter: &HitComparison) -> NodeStatus {
    let range = encounter.ray.range;
    match span {
        _ if is_entered => NodeStatus::Entered,
        None => NodeStatus::Missed,
        Some(span) if span.max < range.min || span.min > range.max => NodeStatus::OutOfRange,
        Some(_) => NodeStatus::Beyond,
    }
}

/// At most so many rows: those on the way to a leaf that matters, then those beside it, then the
/// first of the others.
fn shorten(rows: &[NodeRow], matters: impl Fn(&NodeRow) -> (bool, bool)) -> Vec<NodeRow> {
    let mut ranks: Vec<(usize, usize)> = rows
        .iter()
        .enumerate()
        .map(|(place, row)| match matters(row) {
            (true, _) => (0, place),
            (false, true) => (1, place),
            (false, false) => (2, place),
        })
        .collect();
    // Of a long way its end tells most.
    ranks.sort_by_key(|&(rank, place)| match rank {
        0 => (0, rows.len() - place),
        _ => (rank, place),
    });
    let mut is_kept = vec![false; rows.len()];
    for (_, place) in ranks.into_iter().take(MAX_ROWS) {
        is_kept[place] = true;
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

/// Who is whose parent, below the root.
struct ParentMap(BTreeMap<u32, Option<u32>>);

impl ParentMap {
    fn new(walked: &RecordedTraversal) -> ParentMap {
        let mut parents = BTreeMap::new();
        let mut open = vec![(walked.root, None)];
        while let Some((place, parent)) = open.pop() {
            let Some(node) = walked.nodes.get(place as usize) else {
                continue;
            };
            // A node that has a parent already closes a circle: nobody goes round.
            if parents.contains_key(&place) {
                continue;
            }
            parents.insert(place, parent);
            if !node.is_leaf() {
                open.extend([(node.l, Some(place)), (node.r, Some(place))]);
            }
        }
        ParentMap(parents)
    }

    fn parent(&self, node: u32) -> Option<u32> {
        self.0.get(&node).copied().flatten()
    }

    /// From a node up to the root, both included.
    fn path_to_root(&self, node: u32) -> Vec<u32> {
        std::iter::successors(Some(node), |node| self.parent(*node)).collect()
    }

    fn depth(&self, node: u32) -> usize {
        self.path_to_root(node).len() - 1
    }

    /// The leaf that holds the primitive with this material.
    fn leaf_with(&self, walked: &RecordedTraversal, material: u32) -> Option<u32> {
        let mut places = walked.shapes.iter();
        let place = places.position(|shape| shape.material() == material)? as u64;
        let holds = |node: &&u32| {
            let node = &walked.nodes[**node as usize];
            let start = u64::from(node.start);
            node.is_leaf() && (start..start + u64::from(node.size)).contains(&place)
        };
        self.0.keys().find(holds).copied()
    }
}
