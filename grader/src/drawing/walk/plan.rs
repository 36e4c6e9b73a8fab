//! What is drawn of a walk: which nodes, and what became of each.

use std::collections::BTreeMap;

use protocol::{Interval, TreeNode};

use super::Walked;
use crate::drawing::encounter::{Encounter, Got};

/// The most rows.
const MOST: usize = 28;

/// What became of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
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

impl Fate {
    /// Whether a right walk came to the node, and did not enter it.
    pub(super) fn is_passed_by(self) -> bool {
        match self {
            Fate::Missed | Fate::OutOfRange | Fate::Beyond => true,
            Fate::Entered | Fate::Elided => false,
        }
    }
}

/// A node, or nodes that are left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) node: u32,
    /// Which of those that are entered it is, from 1.
    pub(super) number: usize,
    pub(super) depth: usize,
    pub(super) is_leaf: bool,
    pub(super) fate: Fate,
    pub(super) span: Option<Interval>,
}

/// All that is drawn.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) rows: Vec<Row>,
    /// The leaf with what is hit.
    pub(super) wanted: Option<u32>,
    /// The leaf with what the answer names.
    pub(super) got: Option<u32>,
    /// The nodes from the root down to that leaf.
    way_to_got: Vec<u32>,
}

impl Plan {
    pub(super) fn of(encounter: &Encounter, walked: &Walked) -> Plan {
        let family = Family::of(walked);
        let leaf_with = |material: Option<u32>| family.leaf_with(walked, material?);
        let wanted = leaf_with(encounter.wanted.and_then(|met| met.material));
        let got = match encounter.got {
            Got::Hit(met) => leaf_with(met.material),
            Got::Miss | Got::NoAnswer => None,
        };
        let ways = [wanted, got].map(|leaf| leaf.map_or(Vec::new(), |leaf| family.way(leaf)));

        let mut number = 0;
        let rows: Vec<Row> = walked
            .steps
            .iter()
            .map(|step| {
                number += usize::from(step.is_entered);
                let node = walked.nodes.get(step.node as usize);
                Row {
                    node: step.node,
                    number,
                    depth: family.depth(step.node),
                    is_leaf: node.is_some_and(TreeNode::is_leaf),
                    fate: fate(step.is_entered, step.span, encounter),
                    span: step.span.filter(|span| !span.is_empty()),
                }
            })
            .collect();
        let matters = |row: &Row| {
            let parent = family.parent(row.node);
            let of = |node: u32| ways.iter().any(|way| way.contains(&node));
            (of(row.node), parent.is_some_and(of))
        };
        let [_, way_to_got] = ways.clone();
        Plan {
            rows: shortened(&rows, matters),
            wanted,
            got,
            way_to_got,
        }
    }

    /// The row on the way to the answer's leaf at which a right walk turns away; or the leaf's own.
    pub(super) fn got_row(&self) -> Option<&Row> {
        let on_way = self.rows.iter().filter(|row| {
            let is_node = row.fate != Fate::Elided;
            is_node && self.way_to_got.contains(&row.node)
        });
        on_way.max_by_key(|row| row.depth)
    }

    /// Where the answer comes from a leaf that no right walk enters: the row that leads there.
    pub(super) fn trap(&self) -> Option<&Row> {
        self.got_row().filter(|row| row.fate.is_passed_by())
    }

    /// Which of the entered nodes is the leaf with what is hit.
    pub(super) fn wanted_number(&self) -> Option<usize> {
        let is_it = |row: &&Row| row.fate == Fate::Entered && Some(row.node) == self.wanted;
        self.rows.iter().find(is_it).map(|row| row.number)
    }
}

fn fate(is_entered: bool, span: Option<Interval>, encounter: &Encounter) -> Fate {
    let range = encounter.ray.range;
    match span {
        _ if is_entered => Fate::Entered,
        None => Fate::Missed,
        Some(span) if span.max < range.min || span.min > range.max => Fate::OutOfRange,
        Some(_) => Fate::Beyond,
    }
}

/// At most so many rows: those on the way to a leaf that matters, then those beside it, then the
/// first of the others.
fn shortened(rows: &[Row], matters: impl Fn(&Row) -> (bool, bool)) -> Vec<Row> {
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
    for (_, place) in ranks.into_iter().take(MOST) {
        is_kept[place] = true;
    }
    let mut shown: Vec<Row> = Vec::new();
    for (row, is_kept) in rows.iter().zip(is_kept) {
        match shown.last_mut() {
            _ if is_kept => shown.push(*row),
            Some(last) if last.fate == Fate::Elided => last.node += 1,
            Some(_) | None => shown.push(Row {
                node: 1,
                fate: Fate::Elided,
                span: None,
                ..*row
            }),
        }
    }
    shown
}

/// Who is whose parent, below the root.
struct Family(BTreeMap<u32, Option<u32>>);

impl Family {
    fn of(walked: &Walked) -> Family {
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
        Family(parents)
    }

    fn parent(&self, node: u32) -> Option<u32> {
        self.0.get(&node).copied().flatten()
    }

    /// From a node up to the root, both included.
    fn way(&self, node: u32) -> Vec<u32> {
        std::iter::successors(Some(node), |node| self.parent(*node)).collect()
    }

    fn depth(&self, node: u32) -> usize {
        self.way(node).len() - 1
    }

    /// The leaf that holds the primitive with this material.
    fn leaf_with(&self, walked: &Walked, material: u32) -> Option<u32> {
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
