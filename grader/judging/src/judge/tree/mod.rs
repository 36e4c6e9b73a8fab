//! Trees, judged by what must hold of every one of them and by their cost: there is no one right
//! tree.

pub mod bounds;
pub mod cells;

use protocol::{Outcome, Shape, Tree};

use crate::exam::TreePart;
use crate::judge::measure::in_units_of;
use crate::judge::{
    Comparison, Deviation, Failure, How, Judgement, Measured, Share, Threshold, deviation,
};

use bounds::Bounds;
use cells::{Cell, Mistake, cells};

/// Full marks up to so many times the cost of the exact sweep.
pub const FULL: f64 = 1.12;
/// Half marks.
const HALF: f64 = 1.25;
/// How far a box may exceed what it holds, in diagonals.
pub(super) const LOOSE: f64 = 1e-4;
/// How far a primitive may stick out of its box, in diagonals: what rounding explains.
pub(super) const ROUNDING: f64 = 1e-5;

/// A tree, and what must hold of it.
pub(super) struct Built<'a> {
    pub(super) judged: &'a [TreePart],
    pub(super) sweep_cost: Option<f64>,
    pub(super) shapes: &'a [Shape],
    pub(super) max_leaf_size: u32,
    pub(super) answer: &'a Outcome<Tree>,
}

impl Comparison for Built<'_> {
    fn judge(&self) -> Judgement {
        let tree = match self.answer {
            Outcome::Value(tree) => tree,
            Outcome::Panicked(panic) => {
                return Judgement::wrong(Failure {
                    element: 0,
                    how: How::Panicked(panic.clone()),
                    count: None,
                });
            }
            Outcome::GivenUp => return Judgement::protocol("given up"),
        };
        let cells = match cells(self.shapes, tree) {
            Ok(cells) => cells,
            Err(mistake) => return wrong(mistake),
        };
        let mut judged = self.judged.iter();
        let mistake = judged.find_map(|part| self.part_mistake(*part, &cells));
        match (mistake, self.sweep_cost) {
            (Some(mistake), _) => wrong(mistake),
            (None, None) => Judgement::RIGHT,
            // A cost is only that of this tree if the tree holds every primitive once.
            (None, Some(sweep)) => match partition_mistake(&cells, self.shapes.len()) {
                Some(mistake) => wrong(mistake),
                None => by_cost(cost(&cells) / sweep),
            },
        }
    }

    fn measure(&self) -> Vec<Measured> {
        let cells = match self.answer {
            Outcome::Value(tree) => cells(self.shapes, tree).ok(),
            Outcome::Panicked(_) | Outcome::GivenUp => None,
        };
        let Some(cells) = cells else {
            return deviation::worst([Deviation::WRONG]);
        };
        let parts = self.judged.iter();
        let parts = parts.flat_map(|part| self.part_deviations(*part, &cells));
        let cost =
            self.sweep_cost
                .map(|sweep| match partition_mistake(&cells, self.shapes.len()) {
                    Some(_) => Deviation::WRONG,
                    None => cost_deviation(cost(&cells) / sweep),
                });
        deviation::worst(parts.chain(cost))
    }
}

fn wrong(mistake: Mistake) -> Judgement {
    Judgement::wrong(Failure {
        element: 0,
        how: How::Wrong {
            what: mistake.what.to_owned(),
            got: mistake.got,
            wanted: mistake.wanted,
        },
        count: None,
    })
}

fn by_cost(ratio: f64) -> Judgement {
    if cost_deviation(ratio).is_right() {
        return Judgement::RIGHT;
    }
    let judgement = wrong(Mistake {
        what: "SAH cost",
        got: format!("{ratio:.2} times that of the best split at every node"),
        wanted: format!("at most {FULL:.2} times ({HALF:.2} for half the points)"),
    });
    Judgement {
        share: if ratio <= HALF {
            Share::HALF
        } else {
            Share::NONE
        },
        ..judgement
    }
}

/// How much more a tree costs than the sweep's, to which it is so many times as dear.
fn cost_deviation(ratio: f64) -> Deviation {
    Deviation::of(Threshold::SahCost, in_units_of(FULL - 1.0, ratio - 1.0))
}

impl Built<'_> {
    fn part_mistake(&self, part: TreePart, cells: &[Cell]) -> Option<Mistake> {
        let most = self.max_leaf_size as usize;
        match part {
            TreePart::Partition => partition_mistake(cells, self.shapes.len()),
            TreePart::Contains => cells
                .iter()
                .find(|cell| !too_small(cell).is_right())
                .map(|cell| cell.box_mistake("box too small")),
            TreePart::Tight => cells
                .iter()
                .find(|cell| !too_large(cell).is_right())
                .map(|cell| cell.box_mistake("box too large")),
            TreePart::Split => {
                let all = self.shapes.len();
                let is_half = |cell: &&Cell| cell.leaf.is_some() && 2 * cell.count >= all;
                let leaf = cells.iter().filter(|_| all > 1).find(is_half)?;
                Some(Mistake {
                    what: "splits",
                    got: format!(
                        "leaf {} holds {} of {all} primitives",
                        leaf.place, leaf.count
                    ),
                    wanted: "less than half of them in any leaf".to_owned(),
                })
            }
            TreePart::LeafSize => {
                let leaf = cells
                    .iter()
                    .find(|cell| cell.leaf.is_some() && cell.count > most)?;
                Some(Mistake {
                    what: "leaf size",
                    got: format!("leaf {} holds {} primitives", leaf.place, leaf.count),
                    wanted: format!("at most {most}"),
                })
            }
            TreePart::Stops => {
                let node = cells
                    .iter()
                    .find(|cell| cell.leaf.is_none() && cell.count <= most)?;
                Some(Mistake {
                    what: "splits",
                    got: format!(
                        "node {} was split over {} primitives",
                        node.place, node.count
                    ),
                    wanted: format!("a leaf, as soon as there are at most {most}"),
                })
            }
        }
    }

    fn part_deviations(&self, part: TreePart, cells: &[Cell]) -> Vec<Deviation> {
        match part {
            TreePart::Contains => cells.iter().map(too_small).collect(),
            TreePart::Tight => cells.iter().map(too_large).collect(),
            TreePart::Partition | TreePart::Split | TreePart::LeafSize | TreePart::Stops => {
                vec![Deviation::unless(self.part_mistake(part, cells).is_none())]
            }
        }
    }
}

/// How far a node's primitives stick out of its box. The box of a node without any is not read.
pub fn too_small(cell: &Cell) -> Deviation {
    let out = match cell.count {
        0 => 0.0,
        _ => cell.needs.sticks_out_of(Bounds::of(cell.node)),
    };
    let limit = ROUNDING * cell.needs.diagonal();
    Deviation::of(Threshold::BoxTooSmall, in_units_of(limit, out))
}

/// How far a node's box exceeds what its primitives need.
pub fn too_large(cell: &Cell) -> Deviation {
    let out = match cell.count {
        0 => 0.0,
        _ => Bounds::of(cell.node).sticks_out_of(cell.needs),
    };
    let limit = LOOSE * cell.needs.diagonal();
    Deviation::of(Threshold::BoxTooLarge, in_units_of(limit, out))
}

fn partition_mistake(cells: &[Cell], primitives: usize) -> Option<Mistake> {
    let mut leaves_of = vec![0; primitives];
    for &primitive in cells.iter().filter_map(|cell| cell.leaf.as_ref()).flatten() {
        leaves_of[primitive] += 1;
    }
    let (primitive, leaves) = leaves_of
        .iter()
        .enumerate()
        .find(|(_, leaves)| **leaves != 1)?;
    Some(Mistake {
        what: "leaves",
        got: format!("primitive {primitive} of {primitives} is in {leaves} leaves"),
        wanted: "each primitive in exactly one".to_owned(),
    })
}

/// Σ S/S_root over interior nodes + Σ n · S/S_root over leaves (C_trav = C_isect = 1), with the
/// boxes that the primitives need: MacDonald and Booth, "Heuristics for ray tracing using space
/// subdivision", The Visual Computer 6, 1990, section 3.
pub fn cost<'a>(cells: impl IntoIterator<Item = &'a Cell<'a>>) -> f64 {
    let mut cells = cells.into_iter().peekable();
    let Some(root) = cells.peek().map(|root| root.needs.area()) else {
        return 0.0;
    };
    let cost = |cell: &Cell| match &cell.leaf {
        None => cell.needs.area(),
        Some(leaf) => cell.needs.area() * leaf.len() as f64,
    };
    cells.map(cost).sum::<f64>() / root
}

#[cfg(test)]
mod tests;
