//! Judges trees by their cost and by properties that every correct tree has, because many different
//! trees are correct.

pub mod bounds;
pub mod defect;
pub mod reached_nodes;

use protocol::{ElementOutcome, Shape, Tree};

use crate::exam::TreeCheck;
use crate::judge::{
    Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Threshold,
    deviation,
};
use crate::types::multiple::in_units_of;

use bounds::Bounds;
use defect::{NodeBox, TreeDefect};
use reached_nodes::{ReachedNode, reached_nodes};

/// Maximum cost for full marks, relative to the cost of the exact sweep's tree.
pub const FULL_MARKS_RATIO: f64 = 1.12;
/// Maximum cost for half marks, relative to the cost of the exact sweep's tree.
const HALF_MARKS_RATIO: f64 = 1.25;
/// The farthest a box may extend beyond its contents, relative to the diagonal of the contents.
pub(super) const TIGHT_TOLERANCE: f64 = 1e-4;
/// The farthest a primitive may extend beyond its box, relative to the diagonal of the contents.
/// This allows for rounding only.
pub(super) const CONTAIN_TOLERANCE: f64 = 1e-5;

/// A tree and the checks on it.
pub(super) struct TreeAnswer<'a> {
    pub(super) criteria: TreeCriteria<'a>,
    pub(super) answer: &'a ElementOutcome<Tree>,
}

/// The criteria for judging a tree.
#[derive(Clone, Copy, Debug)]
pub struct TreeCriteria<'a> {
    /// The properties of the tree that are checked.
    pub checks: &'a [TreeCheck],
    /// The cost of the exact sweep's tree, if the cost is judged.
    pub sweep_cost: Option<f64>,
    /// The primitives that the tree is built over.
    pub shapes: &'a [Shape],
    /// The maximum number of primitives in a leaf.
    pub max_leaf_size: u32,
}

impl Comparison for TreeAnswer<'_> {
    fn judge(&self) -> Judgement {
        let tree = match self.answer {
            ElementOutcome::Value(tree) => tree,
            ElementOutcome::Panicked(panic) => {
                return Judgement::wrong(Failure {
                    element: 0,
                    kind: FailureKind::Panicked(panic.clone()),
                    count: None,
                });
            }
            ElementOutcome::Skipped => return Judgement::protocol("skipped"),
        };
        match self.criteria.defect(tree) {
            None => Judgement::RIGHT,
            Some(defect) => Judgement {
                credit: if matches!(defect, TreeDefect::Cost(ratio) if ratio <= HALF_MARKS_RATIO) {
                    Credit::HALF
                } else {
                    Credit::NONE
                },
                failure: Some(Failure {
                    element: 0,
                    kind: FailureKind::Wrong {
                        what: defect.what().to_owned(),
                        got: defect.got(),
                        wanted: defect.wanted(),
                    },
                    count: None,
                }),
            },
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        let TreeAnswer { criteria, answer } = self;
        let nodes = match answer {
            ElementOutcome::Value(tree) => reached_nodes(criteria.shapes, tree).ok(),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
        };
        let Some(nodes) = nodes else {
            return deviation::worst_by_threshold([Deviation::WRONG]);
        };
        let parts = criteria.checks.iter();
        let parts = parts.flat_map(|part| criteria.check_deviations(*part, &nodes));
        let cost = criteria.sweep_cost.map(|sweep| {
            match partition_defect(&nodes, criteria.shapes.len()) {
                Some(_) => Deviation::WRONG,
                None => cost_deviation(cost(&nodes) / sweep),
            }
        });
        deviation::worst_by_threshold(parts.chain(cost))
    }
}

/// Returns the deviation of a cost that is `ratio` times the cost of the exact sweep's tree.
fn cost_deviation(ratio: f64) -> Deviation {
    Deviation::new(
        Threshold::SahCost,
        in_units_of(FULL_MARKS_RATIO - 1.0, ratio - 1.0),
    )
}

impl TreeCriteria<'_> {
    /// Returns the first defect of a tree.
    pub fn defect(&self, tree: &Tree) -> Option<TreeDefect> {
        let nodes = match reached_nodes(self.shapes, tree) {
            Ok(nodes) => nodes,
            Err(defect) => return Some(defect),
        };
        let mut checks = self.checks.iter();
        checks
            .find_map(|check| self.check_defect(*check, &nodes))
            .or_else(|| {
                // The cost is only meaningful if the tree contains every primitive exactly once.
                let sweep = self.sweep_cost?;
                partition_defect(&nodes, self.shapes.len()).or_else(|| {
                    let ratio = cost(&nodes) / sweep;
                    (!cost_deviation(ratio).is_right()).then_some(TreeDefect::Cost(ratio))
                })
            })
    }

    fn check_defect(&self, check: TreeCheck, nodes: &[ReachedNode]) -> Option<TreeDefect> {
        let (all, most) = (self.shapes.len(), self.max_leaf_size as usize);
        let node = || nodes.iter().find(|node| breaks(check, node, all, most));
        match check {
            TreeCheck::Partition => partition_defect(nodes, all),
            TreeCheck::Contains => Some(TreeDefect::BoxTooSmall(NodeBox::of(node()?))),
            TreeCheck::Tight => Some(TreeDefect::BoxTooLarge(NodeBox::of(node()?))),
            TreeCheck::Split => node().map(|leaf| TreeDefect::NotSplit {
                leaf: leaf.index,
                count: leaf.count,
                all,
            }),
            TreeCheck::LeafSize => node().map(|leaf| TreeDefect::LeafTooLarge {
                leaf: leaf.index,
                count: leaf.count,
                most,
            }),
            TreeCheck::Stops => node().map(|node| TreeDefect::NeedlessSplit {
                node: node.index,
                count: node.count,
                most,
            }),
        }
    }

    fn check_deviations(&self, part: TreeCheck, nodes: &[ReachedNode]) -> Vec<Deviation> {
        match part {
            TreeCheck::Contains => nodes.iter().map(containment_deviation).collect(),
            TreeCheck::Tight => nodes.iter().map(tightness_deviation).collect(),
            TreeCheck::Partition | TreeCheck::Split | TreeCheck::LeafSize | TreeCheck::Stops => {
                vec![Deviation::binary(self.check_defect(part, nodes).is_none())]
            }
        }
    }
}

/// Returns whether a node of a tree over `all` primitives breaks a check. A leaf may have at most
/// `most` of them. The partition is checked elsewhere, because it involves all leaves.
pub fn breaks(check: TreeCheck, node: &ReachedNode, all: usize, most: usize) -> bool {
    let is_leaf = node.leaf_primitives.is_some();
    match check {
        TreeCheck::Partition => false,
        TreeCheck::Contains => !containment_deviation(node).is_right(),
        TreeCheck::Tight => !tightness_deviation(node).is_right(),
        TreeCheck::Split => is_leaf && all > 1 && 2 * node.count >= all,
        TreeCheck::LeafSize => is_leaf && node.count > most,
        TreeCheck::Stops => !is_leaf && node.count <= most,
    }
}

/// Returns how far a node's primitives extend beyond its box. The box of a node without primitives
/// is ignored.
pub fn containment_deviation(node: &ReachedNode) -> Deviation {
    let out = match node.count {
        0 => 0.0,
        _ => node.tight_bounds.excess_over(Bounds::of_node(node.node)),
    };
    let limit = CONTAIN_TOLERANCE * node.tight_bounds.diagonal();
    Deviation::new(Threshold::BoxTooSmall, in_units_of(limit, out))
}

/// Returns how far a node's box exceeds the tightest box around its primitives.
pub fn tightness_deviation(node: &ReachedNode) -> Deviation {
    let out = match node.count {
        0 => 0.0,
        _ => Bounds::of_node(node.node).excess_over(node.tight_bounds),
    };
    let limit = TIGHT_TOLERANCE * node.tight_bounds.diagonal();
    Deviation::new(Threshold::BoxTooLarge, in_units_of(limit, out))
}

/// Returns, for each primitive, the number of leaves that contain it.
pub fn leaves_of_primitives<'a>(
    nodes: impl IntoIterator<Item = &'a ReachedNode<'a>>,
    primitives: usize,
) -> Vec<usize> {
    let mut leaves = vec![0; primitives];
    for &primitive in nodes
        .into_iter()
        .filter_map(|node| node.leaf_primitives.as_ref())
        .flatten()
    {
        leaves[primitive] += 1;
    }
    leaves
}

fn partition_defect(nodes: &[ReachedNode], primitives: usize) -> Option<TreeDefect> {
    let leaves = leaves_of_primitives(nodes, primitives);
    let (primitive, leaves) = leaves
        .iter()
        .enumerate()
        .find(|(_, leaves)| **leaves != 1)?;
    Some(TreeDefect::Partition {
        primitive,
        primitives,
        leaves: *leaves,
    })
}

/// Returns the SAH cost of a tree: Σ S/S_root over interior nodes + Σ n · S/S_root over leaves
/// (C_trav = C_isect = 1), with the tightest boxes around the primitives. See MacDonald and Booth,
/// "Heuristics for ray tracing using space subdivision", The Visual Computer 6, 1990, section 3.
pub fn cost<'a>(nodes: impl IntoIterator<Item = &'a ReachedNode<'a>>) -> f64 {
    let mut nodes = nodes.into_iter().peekable();
    let Some(root) = nodes.peek().map(|root| root.tight_bounds.area()) else {
        return 0.0;
    };
    nodes.map(ReachedNode::cost).sum::<f64>() / root
}

#[cfg(test)]
pub(crate) mod tests;
