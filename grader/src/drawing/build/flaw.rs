//! What is wrong with a tree: the first of what is judged, as the judge sees it.

use super::{BuildCase, NodePosition};
use crate::drawing::numbers::pluralize;
use crate::exam::TreeCheck;
use crate::judge::tree::{self, FULL_MARKS_RATIO};

/// What is wrong.
#[derive(Clone)]
pub(super) enum Flaw<'a> {
    /// A box does not hold all that is below it.
    TooSmall(NodePosition<'a>),
    /// A box is larger than it need be.
    TooLarge(NodePosition<'a>),
    /// A leaf holds too many.
    LeafTooLarge(NodePosition<'a>),
    /// A leaf holds half of all or more.
    NotSplit(NodePosition<'a>),
    /// A node was split that may be a leaf.
    NeedlessSplit(NodePosition<'a>),
    /// Primitives are in no leaf, or in several.
    Partition {
        /// Those in none.
        missing: Vec<usize>,
        /// Those in more than one.
        duplicated: Vec<usize>,
    },
    /// It costs so many times what the sweep's does.
    Cost(f64),
    /// Nothing that is judged.
    None,
}

/// The first flaw of a tree.
pub(super) fn find<'a>(task: &BuildCase, placed: &[NodePosition<'a>]) -> Flaw<'a> {
    let parts = task.judged.iter();
    if let Some(flaw) = parts
        .clone()
        .find_map(|part| find_in_part(*part, task, placed))
    {
        return flaw;
    }
    match task.sweep_cost {
        None => Flaw::None,
        Some(sweep) => find_partition_flaw(task, placed).unwrap_or_else(|| {
            let cells = placed.iter().map(|node| node.cell);
            Flaw::Cost(tree::cost(cells) / sweep)
        }),
    }
}

fn find_in_part<'a>(
    part: TreeCheck,
    task: &BuildCase,
    placed: &[NodePosition<'a>],
) -> Option<Flaw<'a>> {
    let most = task.max_leaf_size as usize;
    let all = task.shapes.len();
    let find = |is: &dyn Fn(&NodePosition) -> bool| placed.iter().find(|node| is(node)).copied();
    let is_leaf = |node: &NodePosition| node.cell.leaf_primitives.is_some();
    match part {
        TreeCheck::Partition => find_partition_flaw(task, placed),
        TreeCheck::Contains => {
            find(&|node| !tree::containment_deviation(node.cell).is_right()).map(Flaw::TooSmall)
        }
        TreeCheck::Tight => {
            find(&|node| !tree::tightness_deviation(node.cell).is_right()).map(Flaw::TooLarge)
        }
        TreeCheck::Split => {
            find(&|node| all > 1 && is_leaf(node) && 2 * node.cell.count >= all).map(Flaw::NotSplit)
        }
        TreeCheck::LeafSize => {
            find(&|node| is_leaf(node) && node.cell.count > most).map(Flaw::LeafTooLarge)
        }
        TreeCheck::Stops => {
            find(&|node| !is_leaf(node) && node.cell.count <= most).map(Flaw::NeedlessSplit)
        }
    }
}

fn find_partition_flaw<'a>(task: &BuildCase, placed: &[NodePosition<'a>]) -> Option<Flaw<'a>> {
    let mut leaves_of = vec![0; task.shapes.len()];
    let leaves = placed
        .iter()
        .filter_map(|node| node.cell.leaf_primitives.as_ref());
    for &primitive in leaves.flatten() {
        leaves_of[primitive] += 1;
    }
    let of = |is: fn(i32) -> bool| -> Vec<usize> {
        let places = leaves_of.iter().enumerate();
        let places = places.filter(|(_, leaves)| is(**leaves));
        places.map(|(place, _)| place).collect()
    };
    let (lost, doubled) = (of(|leaves| leaves == 0), of(|leaves| leaves > 1));
    (!lost.is_empty() || !doubled.is_empty()).then_some(Flaw::Partition {
        missing: lost,
        duplicated: doubled,
    })
}

impl<'a> Flaw<'a> {
    /// The node that it is about.
    pub(super) fn node(&self) -> Option<&NodePosition<'a>> {
        match self {
            Flaw::TooSmall(node)
            | Flaw::TooLarge(node)
            | Flaw::LeafTooLarge(node)
            | Flaw::NotSplit(node)
            | Flaw::NeedlessSplit(node) => Some(node),
            Flaw::Partition { .. } | Flaw::Cost(_) | Flaw::None => None,
        }
    }

    /// What is marked with it.
    pub(super) fn label(&self) -> &'static str {
        match self {
            Flaw::TooSmall(_) => "got: a box that does not hold all below it",
            Flaw::TooLarge(_) => "got: a box that is too large",
            Flaw::LeafTooLarge(_) | Flaw::NotSplit(_) => "got: a leaf that holds too many",
            Flaw::NeedlessSplit(_) => "got: a node that need not be split",
            Flaw::Partition { .. } | Flaw::Cost(_) | Flaw::None => "",
        }
    }

    /// In a sentence.
    pub(super) fn caption(&self, task: &BuildCase) -> String {
        let (all, most) = (task.shapes.len(), task.max_leaf_size);
        match self {
            Flaw::TooSmall(node) => format!(
                "The box of node {} does not hold all that is below it.",
                node.cell.index
            ),
            Flaw::TooLarge(node) => format!(
                "The box of node {} is larger than what is below it needs.",
                node.cell.index
            ),
            Flaw::LeafTooLarge(node) => format!(
                "Leaf {} holds {}; a leaf may hold {most}.",
                node.cell.index,
                pluralize(node.cell.count, "primitive", "primitives")
            ),
            Flaw::NotSplit(node) => format!(
                "Leaf {} holds {} of {all} primitives: they were hardly split.",
                node.cell.index, node.cell.count
            ),
            Flaw::NeedlessSplit(node) => format!(
                "Node {} was split over {}, though {most} may be in a leaf.",
                node.cell.index,
                pluralize(node.cell.count, "primitive", "primitives")
            ),
            Flaw::Partition {
                missing: lost,
                duplicated: doubled,
            } => format!(
                "Of {all} primitives, in no leaf: {}; in more than one: {}.",
                lost.len(),
                doubled.len()
            ),
            Flaw::Cost(ratio) => format!(
                "Your tree costs {ratio:.2} times what it does with the best split at every node; \
                 {FULL_MARKS_RATIO} times is good enough."
            ),
            Flaw::None => "Your tree, and the one with the best split at every node.".to_owned(),
        }
    }
}
