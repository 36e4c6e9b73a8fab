//! Observes wrong trees. Correct builders produce different trees, so nodes and indices aren't
//! compared. Instead, an observation consists of the kind of defect, the nodes affected, and
//! amounts that don't depend on the order of nodes.

use std::collections::{BTreeMap, BTreeSet};

use protocol::{Shape, Tree};

use crate::judge::Deviation;
use crate::judge::tree::bounds::Bounds;
use crate::judge::tree::defect::TreeDefect;
use crate::judge::tree::reached_nodes::{ReachedNode, reached_nodes};
use crate::judge::tree::{containment_deviation, leaves_of_primitives, tightness_deviation};

/// Returns a name and an amount for a defect that the judge found in a tree. Both are stored in
/// exam files as signatures of known mistakes, so if you change them, existing exams recognise
/// fewer mistakes.
pub(super) fn defect(shapes: &[Shape], tree: &Tree, defect: &TreeDefect) -> (String, f32) {
    let what = defect.what();
    let nodes = || reached_nodes(shapes, tree).unwrap_or_default();
    // For other defects, the indices are dropped because they differ between submissions.
    let words = match defect {
        TreeDefect::BoxTooSmall(_) => {
            return of_boxes(shapes, tree, &nodes(), what, containment_deviation);
        }
        TreeDefect::BoxTooLarge(_) => {
            return of_boxes(shapes, tree, &nodes(), what, tightness_deviation);
        }
        TreeDefect::Partition { .. } => return (of_leaves(&nodes(), tree, shapes.len()), 0.0),
        TreeDefect::TooManyListed { .. } | TreeDefect::UnknownPrimitives { .. } => {
            return (of_ranges(tree), 0.0);
        }
        TreeDefect::NoNodes { .. } => "no node at all",
        TreeDefect::UnknownNode { .. } => "node of",
        TreeDefect::ReachedTwice { .. } => "node is reached twice",
        TreeDefect::NotSplit { .. } => "leaf holds of primitives",
        TreeDefect::LeafTooLarge { .. } => "leaf holds primitives",
        TreeDefect::NeedlessSplit { .. } => "node was split over primitives",
        TreeDefect::Cost { .. } => "times that of the best split at every node",
    };
    let amount = if let TreeDefect::Cost { ratio, .. } = defect {
        // Rounded to two decimals, as in the report.
        ((100.0 * ratio).round() / 100.0) as f32
    } else {
        0.0
    };
    (format!("{what}: {words}"), amount)
}

/// Describes which nodes have wrong boxes and how these boxes are wrong. Also returns the
/// difference between the root's box and the box around all shapes, as a multiple of the tolerance.
fn of_boxes(
    shapes: &[Shape],
    tree: &Tree,
    nodes: &[ReachedNode],
    what: &str,
    excess: fn(&ReachedNode) -> Deviation,
) -> (String, f32) {
    let wrong: Vec<&ReachedNode> = nodes
        .iter()
        .filter(|node| !excess(node).is_right())
        .collect();
    let kinds: BTreeSet<&str> = wrong
        .iter()
        .map(|node| match node.leaf_primitives {
            None => "interior nodes",
            Some(_) => "leaves",
        })
        .collect();
    let kinds = Vec::from_iter(kinds).join(" and ");
    let manner = manner(shapes, tree, nodes, &wrong);

    let mut all = Bounds::EMPTY;
    for shape in shapes {
        all.enclose(Bounds::of_shape(shape));
    }
    let root = nodes.iter().find(|node| node.index == tree.root);
    let amount = root.map_or(0.0, |root| {
        let of_all = ReachedNode {
            leaf_primitives: None,
            count: shapes.len(),
            tight_bounds: all,
            ..*root
        };
        excess(&of_all).value as f32
    });
    // Rounding isn't characteristic of a mistake.
    let amount = if amount > 1.0 { amount } else { 0.0 };
    (format!("{what}: {kinds}{manner}"), amount)
}

/// Describes what all wrong boxes have in common.
fn manner(
    shapes: &[Shape],
    tree: &Tree,
    nodes: &[ReachedNode],
    wrong: &[&ReachedNode],
) -> &'static str {
    /// The maximum difference between boxes that count as equal, relative to the diagonal.
    const EQUAL: f64 = 1e-4;
    let siblings = siblings(nodes);
    let is_empty = |node: &&ReachedNode| {
        let own = Bounds::of_node(node.node);
        own.min.cmpgt(own.max).any()
    };
    let is_of_sibling = |node: &&ReachedNode| {
        siblings.get(&node.index).is_some_and(|sibling| {
            let (own, other) = (Bounds::of_node(node.node), sibling.tight_bounds);
            let close = EQUAL * other.diagonal();
            (own.min - other.min).abs().max_element() <= close
                && (own.max - other.max).abs().max_element() <= close
        })
    };
    let numbers = shapes.iter().map(Shape::number);
    if wrong.iter().all(is_empty) {
        ", empty"
    } else if wrong.iter().all(is_of_sibling) {
        ", the sibling's"
    } else if numbers.eq(tree.order.iter().copied()) {
        ", in the original order"
    } else {
        ""
    }
}

/// Returns the sibling of each node, keyed by the node's index.
fn siblings<'a>(nodes: &'a [ReachedNode<'a>]) -> BTreeMap<u32, &'a ReachedNode<'a>> {
    let by_index: BTreeMap<u32, &ReachedNode> =
        nodes.iter().map(|node| (node.index, node)).collect();
    let parents = nodes.iter().filter(|node| node.leaf_primitives.is_none());
    let pairs = parents.flat_map(|parent| {
        let (l, r) = (parent.node.l, parent.node.r);
        [(l, r), (r, l)]
    });
    pairs
        .filter_map(|(node, sibling)| Some((node, *by_index.get(&sibling)?)))
        .collect()
}

/// Describes whether primitives are in no leaf or in several, and whether the root is the only node
/// reached.
fn of_leaves(nodes: &[ReachedNode], tree: &Tree, primitives: usize) -> String {
    let counts = leaves_of_primitives(nodes, primitives);
    let missing = counts.iter().filter(|count| **count == 0).count();
    let repeated = counts.iter().any(|count| *count > 1);
    let missing = match missing {
        0 => "",
        _ if missing == primitives => " all in none",
        _ => " some in none",
    };
    let repeated = if repeated { " some in several" } else { "" };
    let alone = match nodes {
        [_] if tree.root == 0 => ", the first node is alone",
        [_] => ", one node is alone",
        _ => "",
    };
    format!("leaves:{missing}{repeated}{alone}")
}

/// Describes how far leaves extend past the list of primitives.
fn of_ranges(tree: &Tree) -> String {
    let leaves = tree.nodes.iter().filter(|node| node.is_leaf());
    let ends = leaves.map(|leaf| u64::from(leaf.start) + u64::from(leaf.size));
    let excess = ends
        .max()
        .unwrap_or(0)
        .saturating_sub(tree.order.len() as u64);
    match excess {
        0 => "leaves: unknown primitives".to_owned(),
        1 => "leaves: one past the end".to_owned(),
        _ => "leaves: far past the end".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use protocol::TreeNode;

    use crate::exam::{ExamQuestion, TreeCheck};
    use crate::judge::tree::tests::{ALL_CHECKS, row, valid_tree};
    use crate::observe::observe_tree;
    use crate::signatures::ObservedAnswer;

    use super::*;

    /// Changes a tree over four spheres in a row and returns the observation. The tree lists the
    /// spheres in a different order from the question.
    fn defect_after(change: impl FnOnce(&mut Tree)) -> Option<(String, f32)> {
        defect_by(&ALL_CHECKS, change)
    }

    /// Like `defect_after`, but checks only these properties.
    fn defect_by(checks: &[TreeCheck], change: impl FnOnce(&mut Tree)) -> Option<(String, f32)> {
        let question = ExamQuestion::tree(row(4), 2, checks, None);
        let mut tree = valid_tree();
        tree.order.swap(0, 1);
        change(&mut tree);
        let observed = observe_tree(&question, &tree);
        let ObservedAnswer::Tree(defect) = observed else {
            panic!("expected a tree, got {observed:?}");
        };
        defect
    }

    #[track_caller]
    fn assert_name(expected: &str, change: impl FnOnce(&mut Tree)) {
        let defect = defect_after(change);
        assert_eq!(
            defect.as_ref().map(|(name, _)| name.as_str()),
            Some(expected)
        );
    }

    #[test]
    fn boxes_are_observed_by_their_nodes_and_what_they_have_in_common() {
        assert_eq!(defect_after(|_| {}), None);
        assert_name("box too small: interior nodes", |tree| {
            tree.nodes[1].max.x = 3.0
        });
        assert_name("box too large: leaves", |tree| tree.nodes[2].max.x += 1.0);
        assert_name("box too large: interior nodes and leaves", |tree| {
            tree.nodes.iter_mut().for_each(|node| node.max.x += 1.0);
        });
        assert_name("box too small: interior nodes, empty", |tree| {
            (tree.nodes[1].min, tree.nodes[1].max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        });
        assert_name("box too small: leaves, the sibling's", |tree| {
            let (l, r) = (tree.nodes[0], tree.nodes[2]);
            (tree.nodes[0].min, tree.nodes[0].max) = (r.min, r.max);
            (tree.nodes[2].min, tree.nodes[2].max) = (l.min, l.max);
        });
        let off = Vec3::X * 1e-4;
        assert_name("box too small: leaves, the sibling's", |tree| {
            let r = tree.nodes[2];
            (tree.nodes[0].min, tree.nodes[0].max) = (r.min + off, r.max + off);
        });
        // One corner of the box is the same as the sibling's, but the opposite corner isn't.
        assert_name("box too large: leaves", |tree| {
            tree.nodes[0].max = tree.nodes[2].max;
        });
        assert_name("box too small: leaves", |tree| {
            let r = tree.nodes[2];
            (tree.nodes[0].min, tree.nodes[0].max) = (r.min, r.max - Vec3::X);
        });
        // A box is empty if its corners are in the wrong order on one axis.
        assert_name("box too small: interior nodes, empty", |tree| {
            (tree.nodes[1].min.y, tree.nodes[1].max.y) = (0.5, -0.5);
        });
        // Only the properties shared by all wrong boxes are named.
        assert_name("box too small: leaves", |tree| {
            (tree.nodes[0].min, tree.nodes[0].max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
            tree.nodes[2].max.x = 5.0;
        });
        assert_name("box too small: leaves", |tree| {
            let r = tree.nodes[2];
            (tree.nodes[0].min, tree.nodes[0].max) = (r.min, r.max);
            tree.nodes[2].max.x = 5.0;
        });
        assert_name("box too large: leaves", |tree| {
            tree.nodes[2].min = tree.nodes[0].min;
        });
        assert_name("box too small: leaves", |tree| tree.order.rotate_left(1));
        assert_name("box too large: leaves, in the original order", |tree| {
            tree.order = vec![0, 1, 2, 3];
            tree.nodes[0].max.x += 1.0;
        });
    }

    #[test]
    fn the_amount_is_that_of_the_root_and_does_not_depend_on_other_nodes() {
        let amount = |change: fn(&mut Tree)| defect_after(change).map(|(_, amount)| amount);
        assert_eq!(amount(|tree| tree.nodes[2].max.x += 1.0), Some(0.0));
        // An excess of half the root's tolerance is treated as rounding.
        let with_rounding = amount(|tree| {
            tree.nodes[2].max.x += 1.0;
            tree.nodes[1].max.x += 3.5e-4;
        });
        assert_eq!(with_rounding, Some(0.0));
        let diagonal = Vec3::new(7.0, 1.0, 1.0).length();
        let root = amount(|tree| tree.nodes[1].max.x += 1.0).unwrap();
        assert!((root * 1e-4 * diagonal - 1.0).abs() < 1e-3, "{root}");
        // This root reaches only half of the primitives, but the amount takes all of them into
        // account.
        let part = defect_by(&[TreeCheck::Contains], |tree| {
            tree.root = 0;
            tree.nodes[0].max.x = 2.0;
        });
        let amount = part.unwrap().1;
        assert!((amount * 1e-5 * diagonal - 4.5).abs() < 1e-3, "{amount}");
    }

    #[test]
    fn leaves_are_observed_by_what_happens_to_primitives() {
        assert_name("leaves: some in none", |tree| tree.nodes[2].size = 1);
        assert_name("leaves: some in none some in several", |tree| {
            tree.nodes[2].start = 1
        });
        assert_name("leaves: some in several", |tree| tree.nodes[0].size = 3);
        assert_name("leaves: some in none, one node is alone", |tree| {
            tree.root = 2
        });
        assert_name("leaves: some in none, the first node is alone", |tree| {
            tree.root = 0
        });
        assert_name("leaves: all in none, one node is alone", |tree| {
            tree.nodes[1].l = tree.nodes[1].r;
        });
        assert_name("leaves: one past the end", |tree| tree.nodes[2].start = 3);
        assert_name("leaves: far past the end", |tree| tree.nodes[2].size = 4);
        assert_name("leaves: unknown primitives", |tree| tree.order[0] = 77);
        // Neither a longer list nor an interior node's range makes a leaf extend past the list.
        assert_name("leaves: unknown primitives", |tree| {
            (tree.order[0], tree.nodes[1].start) = (77, 9);
            tree.order.push(0);
        });
    }

    #[test]
    fn other_defects_are_observed_by_words_without_indices() {
        assert_name("child l: node of", |tree| tree.nodes[1].l = 9);
        assert_name("root: node of", |tree| tree.root = 9);
        assert_name("nodes: node is reached twice", |tree| tree.nodes[1].r = 1);
        assert_name("nodes: no node at all", |tree| tree.nodes.clear());
        assert_name("leaf size: leaf holds primitives", |tree| {
            tree.nodes[1] = TreeNode::new(tree.nodes[1].min, tree.nodes[1].max, 0, 4, 0, 0);
        });
        let split = defect_by(&[TreeCheck::Split], |_| {});
        assert_eq!(
            split,
            Some(("splits: leaf holds of primitives".into(), 0.0))
        );
        let stops = defect_by(&[TreeCheck::Stops], |tree| tree.nodes[0].size = 0);
        assert_eq!(
            stops,
            Some(("splits: node was split over primitives".into(), 0.0))
        );
    }
}
