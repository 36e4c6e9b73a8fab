//! What is wrong with a tree: the first of what is judged, as the judge sees it.

use super::{Placed, Task};
use crate::drawing::words::counted;
use crate::exam::TreePart;
use crate::judge::tree::{self, FULL};

/// What is wrong.
#[derive(Clone)]
pub(super) enum Flaw<'a> {
    /// A box does not hold all that is below it.
    TooSmall(Placed<'a>),
    /// A box is larger than it need be.
    TooLarge(Placed<'a>),
    /// A leaf holds too many.
    Leaf(Placed<'a>),
    /// A leaf holds half of all or more.
    NotSplit(Placed<'a>),
    /// A node was split that may be a leaf.
    Split(Placed<'a>),
    /// Primitives are in no leaf, or in several.
    Partition {
        /// Those in none.
        lost: Vec<usize>,
        /// Those in more than one.
        doubled: Vec<usize>,
    },
    /// It costs so many times what the sweep's does.
    Cost(f64),
    /// Nothing that is judged.
    None,
}

/// The first flaw of a tree.
pub(super) fn find<'a>(task: &Task, placed: &[Placed<'a>]) -> Flaw<'a> {
    let parts = task.judged.iter();
    if let Some(flaw) = parts.clone().find_map(|part| of_part(*part, task, placed)) {
        return flaw;
    }
    match task.sweep_cost {
        None => Flaw::None,
        Some(sweep) => partition(task, placed).unwrap_or_else(|| {
            let cells = placed.iter().map(|node| node.cell);
            Flaw::Cost(tree::cost(cells) / sweep)
        }),
    }
}

fn of_part<'a>(part: TreePart, task: &Task, placed: &[Placed<'a>]) -> Option<Flaw<'a>> {
    let most = task.max_leaf_size as usize;
    let all = task.shapes.len();
    let find = |is: &dyn Fn(&Placed) -> bool| placed.iter().find(|node| is(node)).copied();
    let is_leaf = |node: &Placed| node.cell.leaf.is_some();
    match part {
        TreePart::Partition => partition(task, placed),
        TreePart::Contains => {
            find(&|node| !tree::too_small(node.cell).is_right()).map(Flaw::TooSmall)
        }
        TreePart::Tight => find(&|node| !tree::too_large(node.cell).is_right()).map(Flaw::TooLarge),
        TreePart::Split => {
            find(&|node| all > 1 && is_leaf(node) && 2 * node.cell.count >= all).map(Flaw::NotSplit)
        }
        TreePart::LeafSize => find(&|node| is_leaf(node) && node.cell.count > most).map(Flaw::Leaf),
        TreePart::Stops => find(&|node| !is_leaf(node) && node.cell.count <= most).map(Flaw::Split),
    }
}

fn partition<'a>(task: &Task, placed: &[Placed<'a>]) -> Option<Flaw<'a>> {
    let mut leaves_of = vec![0; task.shapes.len()];
    let leaves = placed.iter().filter_map(|node| node.cell.leaf.as_ref());
    for &primitive in leaves.flatten() {
        leaves_of[primitive] += 1;
    }
    let of = |is: fn(i32) -> bool| -> Vec<usize> {
        let places = leaves_of.iter().enumerate();
        let places = places.filter(|(_, leaves)| is(**leaves));
        places.map(|(place, _)| place).collect()
    };
    let (lost, doubled) = (of(|leaves| leaves == 0), of(|leaves| leaves > 1));
    (!lost.is_empty() || !doubled.is_empty()).then_some(Flaw::Partition { lost, doubled })
}

impl<'a> Flaw<'a> {
    /// The node that it is about.
    pub(super) fn node(&self) -> Option<&Placed<'a>> {
        match self {
            Flaw::TooSmall(node)
            | Flaw::TooLarge(node)
            | Flaw::Leaf(node)
            | Flaw::NotSplit(node)
            | Flaw::Split(node) => Some(node),
            Flaw::Partition { .. } | Flaw::Cost(_) | Flaw::None => None,
        }
    }

    /// What is marked with it.
    pub(super) fn label(&self) -> &'static str {
        match self {
            Flaw::TooSmall(_) => "got: a box that does not hold all below it",
            Flaw::TooLarge(_) => "got: a box that is too large",
            Flaw::Leaf(_) | Flaw::NotSplit(_) => "got: a leaf that holds too many",
            Flaw::Split(_) => "got: a node that need not be split",
            Flaw::Partition { .. } | Flaw::Cost(_) | Flaw::None => "",
        }
    }

    /// In a sentence.
    pub(super) fn sentence(&self, task: &Task) -> String {
        let (all, most) = (task.shapes.len(), task.max_leaf_size);
        match self {
            Flaw::TooSmall(node) => format!(
                "The box of node {} does not hold all that is below it.",
                node.cell.place
            ),
            Flaw::TooLarge(node) => format!(
                "The box of node {} is larger than what is below it needs.",
                node.cell.place
            ),
            Flaw::Leaf(node) => format!(
                "Leaf {} holds {}; a leaf may hold {most}.",
                node.cell.place,
                counted(node.cell.count, "primitive", "primitives")
            ),
            Flaw::NotSplit(node) => format!(
                "Leaf {} holds {} of {all} primitives: they were hardly split.",
                node.cell.place, node.cell.count
            ),
            Flaw::Split(node) => format!(
                "Node {} was split over {}, though {most} may be in a leaf.",
                node.cell.place,
                counted(node.cell.count, "primitive", "primitives")
            ),
            Flaw::Partition { lost, doubled } => format!(
                "Of {all} primitives, in no leaf: {}; in more than one: {}.",
                lost.len(),
                doubled.len()
            ),
            Flaw::Cost(ratio) => format!(
                "Your tree costs {ratio:.2} times what it does with the best split at every node; \
                 {FULL} times is good enough."
            ),
            Flaw::None => "Your tree, and the one with the best split at every node.".to_owned(),
        }
    }
}
