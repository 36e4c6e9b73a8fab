//! Trees, judged by what must hold of every one of them and by their cost: there is no one right
//! tree.

mod bounds;
mod cells;

use protocol::{Outcome, Shape, Tree};

use crate::exam::TreePart;
use crate::judge::{Failure, How, Judgement, Share};

use bounds::Bounds;
use cells::{Cell, Mistake, cells};

/// Full marks up to so many times the cost of the exact sweep, and half marks.
const FULL: f64 = 1.12;
const HALF: f64 = 1.25;
/// How far a box may exceed what it holds, in diagonals.
const LOOSE: f64 = 1e-4;
/// How far a primitive may stick out of its box, in diagonals: what rounding explains.
const ROUNDING: f64 = 1e-5;

pub(super) fn judge(
    judged: &[TreePart],
    sweep_cost: Option<f64>,
    shapes: &[Shape],
    max_leaf_size: u32,
    answer: &Outcome<Tree>,
) -> Judgement {
    let tree = match answer {
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
    let cells = match cells(shapes, tree) {
        Ok(cells) => cells,
        Err(mistake) => return wrong(mistake),
    };
    let mistake = judged
        .iter()
        .find_map(|part| part_mistake(*part, &cells, shapes, max_leaf_size));
    match (mistake, sweep_cost) {
        (Some(mistake), _) => wrong(mistake),
        (None, None) => Judgement::RIGHT,
        // A cost is only that of this tree if the tree holds every primitive once.
        (None, Some(sweep)) => match partition_mistake(&cells, shapes.len()) {
            Some(mistake) => wrong(mistake),
            None => by_cost(cost(&cells) / sweep),
        },
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
    if ratio <= FULL {
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

fn part_mistake(
    part: TreePart,
    cells: &[Cell],
    shapes: &[Shape],
    max_leaf_size: u32,
) -> Option<Mistake> {
    let most = max_leaf_size as usize;
    match part {
        TreePart::Partition => partition_mistake(cells, shapes.len()),
        TreePart::Contains => cells.iter().find_map(|cell| {
            let slack = ROUNDING * cell.needs.diagonal();
            let holds = cell.needs.is_within(Bounds::of(cell.node), slack);
            (cell.count > 0 && !holds).then(|| cell.box_mistake("box too small"))
        }),
        TreePart::Tight => cells.iter().find_map(|cell| {
            let slack = LOOSE * cell.needs.diagonal();
            let tight = Bounds::of(cell.node).is_within(cell.needs, slack);
            (cell.count > 0 && !tight).then(|| cell.box_mistake("box too large"))
        }),
        TreePart::Split => {
            let all = shapes.len();
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
fn cost(cells: &[Cell]) -> f64 {
    let Some(root) = cells.first() else {
        return 0.0;
    };
    let cost = |cell: &Cell| match &cell.leaf {
        None => cell.needs.area(),
        Some(leaf) => cell.needs.area() * leaf.len() as f64,
    };
    cells.iter().map(cost).sum::<f64>() / root.needs.area()
}

#[cfg(test)]
mod tests;
