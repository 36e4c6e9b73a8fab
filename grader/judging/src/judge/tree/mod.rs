//! Judges trees by their cost and by properties that every correct tree has, because many different
//! trees are correct.

pub mod bounds;
pub mod defect;
pub mod reached_nodes;

use protocol::{ElementOutcome, Question, Shape, Tree};

use crate::exam::{ExamQuestion, Key, TreeCheck};
use crate::judge::{
    Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Threshold,
    deviation,
};
use crate::types::in_units_of;

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

/// A submitted tree and the criteria for judging it.
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

impl<'a> TreeCriteria<'a> {
    /// Returns the criteria for a question, or `None` if it doesn't ask for a tree.
    pub fn of(question: &'a ExamQuestion) -> Option<Self> {
        match (&question.question, &question.key) {
            (
                Question::Build {
                    shapes,
                    max_leaf_size,
                },
                Key::Tree { checks, sweep_cost },
            ) => Some(TreeCriteria {
                checks,
                sweep_cost: *sweep_cost,
                shapes,
                max_leaf_size: *max_leaf_size,
            }),
            _ => None,
        }
    }
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
                credit: if matches!(defect, TreeDefect::Cost { ratio, .. } if ratio <= HALF_MARKS_RATIO)
                {
                    Credit::HALF
                } else {
                    Credit::NONE
                },
                failure: Some(Failure {
                    element: 0,
                    kind: FailureKind::Wrong {
                        what: defect.what().to_owned(),
                        side: defect.side(),
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
        let cost = criteria
            .sweep_cost
            .map(|sweep| match criteria.cost(&nodes) {
                Ok(cost) => cost_deviation(cost / sweep),
                Err(_) => Deviation::WRONG,
            });
        deviation::worst_by_threshold(parts.chain(cost))
    }
}

/// Returns the deviation for a cost that is `ratio` times the cost of the exact sweep's tree.
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
            .find_map(|check| self.check_defects(*check, &nodes).next())
            .or_else(|| {
                let sweep = self.sweep_cost?;
                let ratio = match self.cost(&nodes) {
                    Ok(cost) => cost / sweep,
                    Err(defect) => return Some(defect),
                };
                (!cost_deviation(ratio).is_right()).then(|| TreeDefect::Cost {
                    ratio,
                    root_split: root_split(&nodes),
                })
            })
    }

    /// Returns the SAH cost of a tree. If the tree doesn't contain every primitive exactly once,
    /// its cost is meaningless, and the first such defect is returned instead.
    pub fn cost(&self, nodes: &[ReachedNode]) -> Result<f64, TreeDefect> {
        let mut defects = self.check_defects(TreeCheck::Partition, nodes);
        defects.next().map_or_else(|| Ok(cost(nodes)), Err)
    }

    /// Returns all defects that a check finds in a tree.
    pub fn check_defects(
        &self,
        check: TreeCheck,
        nodes: &[ReachedNode],
    ) -> impl Iterator<Item = TreeDefect> {
        let (all, most) = (self.shapes.len(), self.max_leaf_size as usize);
        let leaves = if check == TreeCheck::Partition {
            leaves_of_primitives(nodes, all)
        } else {
            Vec::new()
        };
        let in_wrong_leaves = leaves.into_iter().enumerate();
        let partition = in_wrong_leaves.filter(|(_, leaves)| *leaves != 1);
        let partition = partition.map(move |(primitive, leaves)| TreeDefect::Partition {
            primitive,
            primitives: all,
            leaves,
        });
        let broken = nodes
            .iter()
            .filter(move |node| breaks(check, node, all, most));
        partition.chain(broken.filter_map(move |node| node_defect(check, node, all, most)))
    }

    fn check_deviations(&self, part: TreeCheck, nodes: &[ReachedNode]) -> Vec<Deviation> {
        match part {
            TreeCheck::Contains => nodes.iter().map(containment_deviation).collect(),
            TreeCheck::Tight => nodes.iter().map(tightness_deviation).collect(),
            TreeCheck::Partition | TreeCheck::Split | TreeCheck::LeafSize | TreeCheck::Stops => {
                vec![Deviation::binary(
                    self.check_defects(part, nodes).next().is_none(),
                )]
            }
        }
    }
}

/// Returns whether a node of a tree over `all` primitives fails a check. A leaf may have at most
/// `most` primitives. The partition is checked elsewhere, because it involves all leaves.
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

/// Returns the defect of a node that fails a check.
fn node_defect(
    check: TreeCheck,
    node: &ReachedNode,
    all: usize,
    most: usize,
) -> Option<TreeDefect> {
    let (index, count) = (node.index, node.count);
    match check {
        TreeCheck::Partition => None,
        TreeCheck::Contains => Some(TreeDefect::BoxTooSmall(NodeBox::of(node))),
        TreeCheck::Tight => Some(TreeDefect::BoxTooLarge(NodeBox::of(node))),
        TreeCheck::Split => Some(TreeDefect::NotSplit {
            leaf: index,
            count,
            all,
        }),
        TreeCheck::LeafSize => Some(TreeDefect::LeafTooLarge {
            leaf: index,
            count,
            most,
        }),
        TreeCheck::Stops => Some(TreeDefect::NeedlessSplit {
            node: index,
            count,
            most,
        }),
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

/// Returns the numbers of primitives below the root's two children, unless the root is a leaf.
fn root_split(nodes: &[ReachedNode]) -> Option<[usize; 2]> {
    let root = nodes
        .first()
        .filter(|root| root.leaf_primitives.is_none())?;
    let count = |child| Some(nodes.iter().find(|node| node.index == child)?.count);
    Some([count(root.node.l)?, count(root.node.r)?])
}

/// Returns the SAH cost of a tree: Σ S/S_root over interior nodes + Σ n · S/S_root over leaves
/// (C_trav = C_isect = 1), computed with the tightest boxes around the primitives. Empty leaves
/// cost nothing. See MacDonald and Booth, "Heuristics for ray tracing using space subdivision", The
/// Visual Computer 6, 1990, section 3.
pub fn cost<'a>(nodes: impl IntoIterator<Item = &'a ReachedNode<'a>>) -> f64 {
    let mut nodes = nodes.into_iter().peekable();
    let root = nodes.peek().map_or(0.0, |root| root.tight_bounds.area());
    // A tree without primitives has no area, and costs nothing.
    nodes.map(ReachedNode::cost).sum::<f64>() / root.max(f64::MIN_POSITIVE)
}

#[cfg(test)]
pub(crate) mod tests;
