//! Describes the flaw in a tree: either the defect that the judge finds and the node that has it,
//! or the tree's cost.

use judging::judge::tree::defect::TreeDefect;
use judging::judge::tree::reached_nodes::ReachedNode;
use judging::judge::tree::{self, FULL_MARKS_RATIO, TreeCriteria};

use crate::machine::printing::counted;

/// The flaw in a tree.
pub(super) struct Flaw<'a> {
    /// The defect found by the judge.
    pub(super) defect: Option<TreeDefect>,
    /// The node with the defect, or `None` if the defect concerns the whole tree.
    pub(super) node: Option<&'a ReachedNode<'a>>,
    /// The primitives that are in no leaf.
    pub(super) missing: Vec<usize>,
    /// The primitives that are in more than one leaf.
    pub(super) duplicated: Vec<usize>,
}

impl<'a> Flaw<'a> {
    /// Returns the flaw in a tree that has this defect.
    pub(super) fn new(
        criteria: &TreeCriteria,
        defect: Option<TreeDefect>,
        nodes: &'a [ReachedNode<'a>],
    ) -> Self {
        let index = defect.as_ref().and_then(TreeDefect::node);
        let leaves_of = tree::leaves_of_primitives(nodes, criteria.shapes.len());
        let of = |is: fn(usize) -> bool| -> Vec<usize> {
            let primitives = (0..).zip(&leaves_of);
            let primitives = primitives.filter(|(_, leaves)| is(**leaves));
            primitives.map(|(primitive, _)| primitive).collect()
        };
        Flaw {
            defect,
            node: nodes.iter().find(|node| Some(node.index) == index),
            missing: of(|leaves| leaves == 0),
            duplicated: of(|leaves| leaves > 1),
        }
    }

    /// Returns the text that describes the marked node in the legend.
    pub(super) fn label(&self) -> &'static str {
        match &self.defect {
            Some(TreeDefect::BoxTooSmall(_)) => "got: a box that does not contain everything",
            Some(TreeDefect::BoxTooLarge(_)) => "got: a box that is too large",
            Some(TreeDefect::LeafTooLarge { .. } | TreeDefect::NotSplit { .. }) => {
                "got: a leaf with too many primitives"
            }
            Some(TreeDefect::NeedlessSplit { .. }) => "got: a split node that should be a leaf",
            _ => "",
        }
    }

    /// Returns a sentence that describes the flaw. `cost` is the tree's SAH cost.
    pub(super) fn caption(&self, criteria: &TreeCriteria, cost: f64) -> String {
        let all = criteria.shapes.len();
        let primitives = |count| counted(count, "primitive");
        let are = |indices: &[usize]| match indices.len() {
            1 => "1 is".to_owned(),
            count => format!("{count} are"),
        };
        match &self.defect {
            Some(TreeDefect::BoxTooSmall(node)) => format!(
                "The box of node {} does not contain everything below the node.",
                node.index
            ),
            Some(TreeDefect::BoxTooLarge(node)) => {
                format!("The box of node {} is larger than necessary.", node.index)
            }
            Some(TreeDefect::LeafTooLarge { leaf, count, most }) => {
                format!(
                    "Leaf {leaf} has {}; the maximum is {most}.",
                    primitives(*count)
                )
            }
            Some(TreeDefect::NotSplit { leaf, count, .. }) => {
                format!("Leaf {leaf} has {count} of {all} primitives: the tree is barely split.")
            }
            Some(TreeDefect::NeedlessSplit { node, count, most }) => format!(
                "Node {node} is split even though it only has {}; a leaf can hold up to {most}.",
                primitives(*count)
            ),
            Some(TreeDefect::Partition { .. }) => format!(
                "Of {all} primitives, {} in no leaf and {} in more than one.",
                are(&self.missing),
                are(&self.duplicated)
            ),
            _ => match criteria.sweep_cost {
                Some(sweep) => format!(
                    "Your tree costs {:.2} times as much as the tree with the best split at every \
                     node; up to {FULL_MARKS_RATIO} times earns full marks.",
                    cost / sweep
                ),
                None => "Your tree, and the tree with the best split at every node.".to_owned(),
            },
        }
    }
}
