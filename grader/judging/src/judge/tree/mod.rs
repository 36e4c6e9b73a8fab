//! Trees, judged by what must hold of every one of them and by their cost: there is no one right
//! tree.

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

/// Full marks up to so many times the cost of the exact sweep.
pub const FULL_MARKS_RATIO: f64 = 1.12;
/// Half marks.
const HALF_MARKS_RATIO: f64 = 1.25;
/// How far a box may exceed what it holds, in diagonals.
pub(super) const TIGHT_TOLERANCE: f64 = 1e-4;
/// How far a primitive may stick out of its box, in diagonals: what rounding explains.
pub(super) const CONTAIN_TOLERANCE: f64 = 1e-5;

/// A tree, and what must hold of it.
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
            ElementOutcome::Skipped => return Judgement::protocol("given up"),
        };
        let cells = match reached_nodes(self.shapes, tree) {
            Ok(cells) => cells,
            Err(mistake) => return wrong_tree(mistake),
        };
        let mut judged = self.checks.iter();
        let mistake = judged.find_map(|part| self.check_defect(*part, &cells));
        match (mistake, self.sweep_cost) {
            (Some(mistake), _) => wrong_tree(mistake),
            (None, None) => Judgement::RIGHT,
            // A cost is only that of this tree if the tree holds every primitive once.
            (None, Some(sweep)) => match partition_defect(&cells, self.shapes.len()) {
                Some(mistake) => wrong_tree(mistake),
                None => judge_cost(cost(&cells) / sweep),
            },
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        let cells = match self.answer {
            ElementOutcome::Value(tree) => reached_nodes(self.shapes, tree).ok(),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
        };
        let Some(cells) = cells else {
            return deviation::worst_by_threshold([Deviation::WRONG]);
        };
        let parts = self.checks.iter();
        let parts = parts.flat_map(|part| self.check_deviations(*part, &cells));
        let cost = self
            .sweep_cost
            .map(|sweep| match partition_defect(&cells, self.shapes.len()) {
                Some(_) => Deviation::WRONG,
                None => cost_deviation(cost(&cells) / sweep),
            });
        deviation::worst_by_threshold(parts.chain(cost))
    }
}

fn wrong_tree(mistake: TreeDefect) -> Judgement {
    Judgement::wrong(Failure {
        element: 0,
        kind: FailureKind::Wrong {
            what: mistake.what.to_owned(),
            got: mistake.got,
            wanted: mistake.wanted,
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

/// How much more a tree costs than the sweep's, to which it is so many times as dear.
fn cost_deviation(ratio: f64) -> Deviation {
    Deviation::new(
        Threshold::SahCost,
        in_units_of(FULL_MARKS_RATIO - 1.0, ratio - 1.0),
    )
}

impl TreeAnswer<'_> {
    fn check_defect(&self, part: TreeCheck, cells: &[ReachedNode]) -> Option<TreeDefect> {
        let most = self.max_leaf_size as usize;
        match part {
            TreeCheck::Partition => partition_defect(cells, self.shapes.len()),
            TreeCheck::Contains => cells
                .iter()
                .find(|cell| !containment_deviation(cell).is_right())
                .map(|cell| cell.box_defect("box too small")),
            TreeCheck::Tight => cells
                .iter()
                .find(|cell| !tightness_deviation(cell).is_right())
                .map(|cell| cell.box_defect("box too large")),
            TreeCheck::Split => {
                let all = self.shapes.len();
                let is_half =
                    |cell: &&ReachedNode| cell.leaf_primitives.is_some() && 2 * cell.count >= all;
                let leaf = cells.iter().filter(|_| all > 1).find(is_half)?;
                Some(TreeDefect {
                    what: "splits",
                    got: format!(
                        "leaf {} holds {} of {all} primitives",
                        leaf.index, leaf.count
                    ),
                    wanted: "less than half of them in any leaf".to_owned(),
                })
            }
            TreeCheck::LeafSize => {
                let leaf = cells
                    .iter()
                    .find(|cell| cell.leaf_primitives.is_some() && cell.count > most)?;
                Some(TreeDefect {
                    what: "leaf size",
                    got: format!("leaf {} holds {} primitives", leaf.index, leaf.count),
                    wanted: format!("at most {most}"),
                })
            }
            TreeCheck::Stops => {
                let node = cells
                    .iter()
                    .find(|cell| cell.leaf_primitives.is_none() && cell.count <= most)?;
                Some(TreeDefect {
                    what: "splits",
                    got: format!(
                        "node {} was split over {} primitives",
                        node.index, node.count
                    ),
                    wanted: format!("a leaf, as soon as there are at most {most}"),
                })
            }
        }
    }

    fn check_deviations(&self, part: TreeCheck, cells: &[ReachedNode]) -> Vec<Deviation> {
        match part {
            TreeCheck::Contains => cells.iter().map(containment_deviation).collect(),
            TreeCheck::Tight => cells.iter().map(tightness_deviation).collect(),
            TreeCheck::Partition | TreeCheck::Split | TreeCheck::LeafSize | TreeCheck::Stops => {
                vec![Deviation::binary(self.check_defect(part, cells).is_none())]
            }
        }
    }
}

/// How far a node's primitives stick out of its box. The box of a node without any is not read.
pub fn containment_deviation(cell: &ReachedNode) -> Deviation {
    let out = match cell.count {
        0 => 0.0,
        _ => cell.tight_bounds.excess_over(Bounds::of_node(cell.node)),
    };
    let limit = CONTAIN_TOLERANCE * cell.tight_bounds.diagonal();
    Deviation::new(Threshold::BoxTooSmall, in_units_of(limit, out))
}

/// How far a node's box exceeds what its primitives need.
pub fn tightness_deviation(cell: &ReachedNode) -> Deviation {
    let out = match cell.count {
        0 => 0.0,
        _ => Bounds::of_node(cell.node).excess_over(cell.tight_bounds),
    };
    let limit = TIGHT_TOLERANCE * cell.tight_bounds.diagonal();
    Deviation::new(Threshold::BoxTooLarge, in_units_of(limit, out))
}

fn partition_defect(cells: &[ReachedNode], primitives: usize) -> Option<TreeDefect> {
    let mut leaves_of = vec![0; primitives];
    for &primitive in cells
        .iter()
        .filter_map(|cell| cell.leaf_primitives.as_ref())
        .flatten()
    {
        leaves_of[primitive] += 1;
    }
    let (primitive, leaves) = leaves_of
        .iter()
        .enumerate()
        .find(|(_, leaves)| **leaves != 1)?;
    Some(TreeDefect {
        what: "leaves",
        got: format!("primitive {primitive} of {primitives} is in {leaves} leaves"),
        wanted: "each primitive in exactly one".to_owned(),
    })
}

/// Σ S/S_root over interior nodes + Σ n · S/S_root over leaves (C_trav = C_isect = 1), with the
/// boxes that the primitives need: MacDonald and Booth, "Heuristics for ray tracing using space
/// subdivision", The Visual Computer 6, 1990, section 3.
pub fn cost<'a>(cells: impl IntoIterator<Item = &'a ReachedNode<'a>>) -> f64 {
    let mut cells = cells.into_iter().peekable();
    let Some(root) = cells.peek().map(|root| root.tight_bounds.area()) else {
        return 0.0;
    };
    let cost = |cell: &ReachedNode| match &cell.leaf_primitives {
        None => cell.tight_bounds.area(),
        Some(leaf) => cell.tight_bounds.area() * leaf.len() as f64,
    };
    cells.map(cost).sum::<f64>() / root
}

#[cfg(test)]
mod tests;
