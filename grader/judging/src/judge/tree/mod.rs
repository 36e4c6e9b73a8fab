//! Judges trees by properties that every correct tree has, and by their cost, because there is no
//! single correct tree.

pub mod bounds;
pub mod reached_nodes;

use protocol::{ElementOutcome, Shape, Tree};

use crate::exam::TreeCheck;
use crate::judge::measure::in_units_of;
use crate::judge::{
    Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Threshold,
    deviation,
};

use bounds::Bounds;
use reached_nodes::{ReachedNode, TreeDefect, reached_nodes};

/// Maximum cost for full marks, relative to the cost of the exact sweep's tree.
pub const FULL_MARKS_RATIO: f64 = 1.12;
/// Maximum cost for half marks, relative to the cost of the exact sweep's tree.
const HALF_MARKS_RATIO: f64 = 1.25;
/// Maximum distance by which a box may extend beyond its contents, relative to the diagonal of the
/// contents.
pub(super) const TIGHT_TOLERANCE: f64 = 1e-4;
/// Maximum distance by which a primitive may extend beyond its box, relative to the diagonal of the
/// contents. This allows for rounding only.
pub(super) const CONTAIN_TOLERANCE: f64 = 1e-5;

/// The name of the defect that a box does not contain its primitives.
pub const BOX_TOO_SMALL: &str = "box too small";
/// The name of the defect that a box is larger than necessary.
pub const BOX_TOO_LARGE: &str = "box too large";
/// The name of the defect that a primitive is not in exactly one leaf.
pub const LEAVES: &str = "leaves";

/// A tree and the checks on it.
pub(super) struct TreeAnswer<'a> {
    pub(super) checks: &'a [TreeCheck],
    pub(super) sweep_cost: Option<f64>,
    pub(super) shapes: &'a [Shape],
    pub(super) max_leaf_size: u32,
    pub(super) answer: &'a ElementOutcome<Tree>,
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
        let nodes = match reached_nodes(self.shapes, tree) {
            Ok(nodes) => nodes,
            Err(defect) => return wrong_tree(defect),
        };
        let mut checks = self.checks.iter();
        let defect = checks.find_map(|part| self.check_defect(*part, &nodes));
        match (defect, self.sweep_cost) {
            (Some(defect), _) => wrong_tree(defect),
            (None, None) => Judgement::RIGHT,
            // The cost is meaningful only if the tree holds every primitive exactly once.
            (None, Some(sweep)) => match partition_defect(&nodes, self.shapes.len()) {
                Some(defect) => wrong_tree(defect),
                None => judge_cost(cost(&nodes) / sweep),
            },
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        let nodes = match self.answer {
            ElementOutcome::Value(tree) => reached_nodes(self.shapes, tree).ok(),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
        };
        let Some(nodes) = nodes else {
            return deviation::worst_by_threshold([Deviation::WRONG]);
        };
        let parts = self.checks.iter();
        let parts = parts.flat_map(|part| self.check_deviations(*part, &nodes));
        let cost = self
            .sweep_cost
            .map(|sweep| match partition_defect(&nodes, self.shapes.len()) {
                Some(_) => Deviation::WRONG,
                None => cost_deviation(cost(&nodes) / sweep),
            });
        deviation::worst_by_threshold(parts.chain(cost))
    }
}

fn wrong_tree(defect: TreeDefect) -> Judgement {
    Judgement::wrong(Failure {
        element: 0,
        kind: FailureKind::Wrong {
            what: defect.what.to_owned(),
            got: defect.got,
            wanted: defect.wanted,
        },
        count: None,
    })
}

fn judge_cost(ratio: f64) -> Judgement {
    if cost_deviation(ratio).is_right() {
        return Judgement::RIGHT;
    }
    let judgement = wrong_tree(TreeDefect {
        what: "SAH cost",
        got: format!("{ratio:.2} times that of the best split at every node"),
        wanted: format!(
            "at most {FULL_MARKS_RATIO:.2} times ({HALF_MARKS_RATIO:.2} for half the points)"
        ),
    });
    Judgement {
        credit: if ratio <= HALF_MARKS_RATIO {
            Credit::HALF
        } else {
            Credit::NONE
        },
        ..judgement
    }
}

/// Returns the deviation of a cost that is `ratio` times the cost of the exact sweep's tree.
fn cost_deviation(ratio: f64) -> Deviation {
    Deviation::new(
        Threshold::SahCost,
        in_units_of(FULL_MARKS_RATIO - 1.0, ratio - 1.0),
    )
}

impl TreeAnswer<'_> {
    fn check_defect(&self, part: TreeCheck, nodes: &[ReachedNode]) -> Option<TreeDefect> {
        let (all, most) = (self.shapes.len(), self.max_leaf_size as usize);
        let node = || nodes.iter().find(|node| breaks(part, node, all, most));
        match part {
            TreeCheck::Partition => partition_defect(nodes, all),
            TreeCheck::Contains => Some(node()?.box_defect(BOX_TOO_SMALL)),
            TreeCheck::Tight => Some(node()?.box_defect(BOX_TOO_LARGE)),
            TreeCheck::Split => node().map(|leaf| TreeDefect {
                what: "splits",
                got: format!(
                    "leaf {} holds {} of {all} primitives",
                    leaf.index, leaf.count
                ),
                wanted: "less than half of them in any leaf".to_owned(),
            }),
            TreeCheck::LeafSize => node().map(|leaf| TreeDefect {
                what: "leaf size",
                got: format!("leaf {} holds {} primitives", leaf.index, leaf.count),
                wanted: format!("at most {most}"),
            }),
            TreeCheck::Stops => node().map(|node| TreeDefect {
                what: "splits",
                got: format!(
                    "node {} was split over {} primitives",
                    node.index, node.count
                ),
                wanted: format!("a leaf for at most {most} primitives"),
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

/// Returns whether a node of a tree over `all` primitives breaks a check. A leaf may have at most `most`
/// of them. The partition is not a matter of single nodes.
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

/// Returns the number of leaves that hold each primitive.
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
    Some(TreeDefect {
        what: LEAVES,
        got: format!("primitive {primitive} of {primitives} is in {leaves} leaves"),
        wanted: "each primitive in exactly one".to_owned(),
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
    let cost = |node: &ReachedNode| match &node.leaf_primitives {
        None => node.tight_bounds.area(),
        Some(leaf) => node.tight_bounds.area() * leaf.len() as f64,
    };
    nodes.map(cost).sum::<f64>() / root
}

#[cfg(test)]
pub(crate) mod tests;
