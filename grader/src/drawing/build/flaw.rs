//! Finds the first flaw of a tree, in the order in which the judge checks.

use judging::exam::TreeCheck;
use judging::judge::tree::{self, FULL_MARKS_RATIO};

use super::{BuildCase, NodePosition};
use crate::drawing::numbers::pluralize;

/// The first flaw that was found in a tree.
#[derive(Clone)]
pub(super) enum Flaw<'a> {
    /// The box of a node does not contain everything below it.
    TooSmall(NodePosition<'a>),
    /// The box of a node is larger than necessary.
    TooLarge(NodePosition<'a>),
    /// A leaf has too many primitives.
    LeafTooLarge(NodePosition<'a>),
    /// A leaf has at least half of all primitives.
    NotSplit(NodePosition<'a>),
    /// A node was split although it has few enough primitives for a leaf.
    NeedlessSplit(NodePosition<'a>),
    /// Some primitives are in no leaf, or in several.
    Partition {
        /// The primitives that are in no leaf.
        missing: Vec<usize>,
        /// The primitives that are in more than one leaf.
        duplicated: Vec<usize>,
    },
    /// The tree's SAH cost, as a multiple of the cost of the exact sweep's tree.
    Cost(f64),
    /// No judged property is wrong.
    None,
}

/// Returns the first flaw of a tree.
pub(super) fn find<'a>(case: &BuildCase, positions: &[NodePosition<'a>]) -> Flaw<'a> {
    let checks = case.checks.iter();
    if let Some(flaw) = checks
        .clone()
        .find_map(|check| find_for_check(*check, case, positions))
    {
        return flaw;
    }
    match case.sweep_cost {
        None => Flaw::None,
        Some(sweep) => find_partition_flaw(case, positions).unwrap_or_else(|| {
            let reached = positions.iter().map(|node| node.reached);
            Flaw::Cost(tree::cost(reached) / sweep)
        }),
    }
}

fn find_for_check<'a>(
    check: TreeCheck,
    case: &BuildCase,
    positions: &[NodePosition<'a>],
) -> Option<Flaw<'a>> {
    let flaw = match check {
        TreeCheck::Partition => return find_partition_flaw(case, positions),
        TreeCheck::Contains => Flaw::TooSmall,
        TreeCheck::Tight => Flaw::TooLarge,
        TreeCheck::Split => Flaw::NotSplit,
        TreeCheck::LeafSize => Flaw::LeafTooLarge,
        TreeCheck::Stops => Flaw::NeedlessSplit,
    };
    let (all, most) = (case.shapes.len(), case.max_leaf_size as usize);
    let is_broken = |node: &&NodePosition| tree::breaks(check, node.reached, all, most);
    positions.iter().find(is_broken).copied().map(flaw)
}

fn find_partition_flaw<'a>(case: &BuildCase, positions: &[NodePosition<'a>]) -> Option<Flaw<'a>> {
    let reached = positions.iter().map(|node| node.reached);
    let leaves_of = tree::leaves_of_primitives(reached, case.shapes.len());
    let of = |is: fn(usize) -> bool| -> Vec<usize> {
        let primitives = leaves_of.iter().enumerate();
        let primitives = primitives.filter(|(_, leaves)| is(**leaves));
        primitives.map(|(primitive, _)| primitive).collect()
    };
    let (missing, duplicated) = (of(|leaves| leaves == 0), of(|leaves| leaves > 1));
    (!missing.is_empty() || !duplicated.is_empty()).then_some(Flaw::Partition {
        missing,
        duplicated,
    })
}

impl<'a> Flaw<'a> {
    /// Returns the node that has the flaw, or `None` if the flaw concerns the whole tree.
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

    /// Returns the text that describes the marked node in the legend.
    pub(super) fn label(&self) -> &'static str {
        match self {
            Flaw::TooSmall(_) => "got: a box that does not contain everything",
            Flaw::TooLarge(_) => "got: a box that is too large",
            Flaw::LeafTooLarge(_) | Flaw::NotSplit(_) => "got: a leaf with too many primitives",
            Flaw::NeedlessSplit(_) => "got: a split node that should be a leaf",
            Flaw::Partition { .. } | Flaw::Cost(_) | Flaw::None => "",
        }
    }

    /// Returns a sentence that describes the flaw.
    pub(super) fn caption(&self, case: &BuildCase) -> String {
        let (all, max) = (case.shapes.len(), case.max_leaf_size);
        match self {
            Flaw::TooSmall(node) => format!(
                "The box of node {} does not contain everything below the node.",
                node.reached.index
            ),
            Flaw::TooLarge(node) => format!(
                "The box of node {} is larger than necessary.",
                node.reached.index
            ),
            Flaw::LeafTooLarge(node) => format!(
                "Leaf {} has {}; the maximum is {max}.",
                node.reached.index,
                pluralize(node.reached.count, "primitive", "primitives")
            ),
            Flaw::NotSplit(node) => format!(
                "Leaf {} has {} of {all} primitives: the tree is hardly split.",
                node.reached.index, node.reached.count
            ),
            Flaw::NeedlessSplit(node) => format!(
                "Node {} is split although it has only {}; up to {max} belong in one leaf.",
                node.reached.index,
                pluralize(node.reached.count, "primitive", "primitives")
            ),
            Flaw::Partition {
                missing,
                duplicated,
            } => format!(
                "Of {all} primitives, {} in no leaf and {} in more than one.",
                pluralize(missing.len(), "is", "are"),
                pluralize(duplicated.len(), "is", "are")
            ),
            Flaw::Cost(ratio) => format!(
                "Your tree costs {ratio:.2} times as much as the tree with the best split at every \
                 node; up to {FULL_MARKS_RATIO} times earns full marks."
            ),
            Flaw::None => "Your tree, and the tree with the best split at every node.".to_owned(),
        }
    }
}
