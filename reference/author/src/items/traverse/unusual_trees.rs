//! Items about roots at unusual positions, and about empty trees.

use glam::Vec3;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::{Ray, Shape, TreeNode};

use super::{
    FIRST_UNREFERENCED, TRAVERSAL, linear_scan_control, question_without_decoys, ray_from_around,
    soup_tree, traversal_question, unambiguous_rays,
};
use crate::items::{Declaration, ray};
use crate::seed::Rng;
use crate::tree::{RootPosition, Tree, decoy};

pub(super) const ROOT: Declaration = Declaration {
    id: "traverse.root",
    title: "traversal starts at the root, wherever it is in the list of nodes",
    look: "The root is nodes[root]. Any node can be first or last in nodes, even a child, or a \
        node that is not part of the tree. A node is a leaf if and only if l == r.",
    section: "traversal.md#the-root-can-be-any-node",
    tests: &["The tree can be 60…"],
    questions: root,
    ..TRAVERSAL
};

fn root(rng: &mut Rng) -> Vec<ExamQuestion> {
    use RootPosition::{First, Last, Middle};
    let in_front = &mut rng.sequence("traverse.root.child_in_front");
    let question = |position: RootPosition| {
        let tree = soup_tree(rng, 20, 0.9, 1);
        let rays = unambiguous_rays(rng, &tree, [10, 4], ray_from_around);
        let inner = if position == First { First } else { Middle };
        let tree = tree.with_nodes_shuffled(rng, inner);
        traversal_question(&with_detached_subtrees(rng, tree, &rays, position), rays)
    };
    let children: [decoy::Child; 2] = [|root| root.l, |root| root.r];
    let child_in_front = children.map(|child| question_with_a_child_in_front(in_front, child));
    let questions = [First, Middle, Last].map(question).into_iter();
    questions.chain(child_in_front).collect()
}

/// Creates a question about a tree whose first node is a child of the root, to check that 0 is
/// accepted as the index of a child.
fn question_with_a_child_in_front(rng: &mut Rng, child: decoy::Child) -> ExamQuestion {
    let tree = soup_tree(rng, 20, 0.9, 1);
    let rays = unambiguous_rays(rng, &tree, [10, 4], ray_from_around);
    let mut tree = tree.with_nodes_shuffled(rng, RootPosition::Last);
    let child = child(&tree.nodes[tree.root]) as usize;
    tree.swap_nodes(0, child);
    traversal_question(&tree, rays)
}

/// Adds two detached subtrees over primitives in front of the rays. Their roots are at the ends of
/// the node list, unless the tree's own root is there.
fn with_detached_subtrees(
    rng: &mut Rng,
    mut tree: Tree,
    rays: &[Ray],
    position: RootPosition,
) -> Tree {
    let mut add_detached_subtree = |tree: &mut Tree, distance: f64| {
        let triangles = rays.iter().enumerate().map(|(i, ray)| {
            let shape = FIRST_UNREFERENCED + tree.shapes.len() as u32 + i as u32;
            decoy::triangle_across(rng, ray, distance, 0.1, shape)
        });
        let mut left: Vec<Shape> = triangles.collect();
        let right = left.split_off(left.len() / 2);
        let l = tree.add_leaf(left);
        let r = tree.add_leaf(right);
        tree.add_interior(l, r)
    };
    let first = add_detached_subtree(&mut tree, 0.4);
    if position != RootPosition::First {
        tree.swap_nodes(0, first);
    }
    // The node that was added last is at the end of the list.
    let last = add_detached_subtree(&mut tree, 0.6);
    if position == RootPosition::Last {
        tree.swap_nodes(tree.root, last);
    }
    tree
}

pub(super) const NO_NODES: Declaration = Declaration {
    id: "traverse.no_nodes",
    title: "an empty tree has no hits, but a tree with a single leaf can",
    look: "An empty tree has either no nodes or a single leaf of size 0, with l == r as in any \
           other leaf. In the first case, there is no node at index root; in the second, there is \
           no primitive at start.",
    look_fits: &[Symptom::HIT],
    section: "traversal.md#an-empty-tree-has-no-nodes",
    tests: &["The tree can be 60…"],
    questions: no_nodes,
    ..TRAVERSAL
};

fn no_nodes(rng: &mut Rng) -> Vec<ExamQuestion> {
    let nothing = Tree::default();
    let mut empty_leaf = nothing.clone();
    let empty_box = TreeNode::new(Vec3::NEG_ONE, Vec3::ONE, 0, 0, 0, 0);
    empty_leaf.nodes.push(empty_box);
    let toward = |rng: &mut Rng| {
        let target = rng.point(0.8);
        ray(target + 4.0 * rng.direction(), target)
    };
    let mut empty_question = |tree: &Tree| traversal_question(tree, rng.list(8, toward));
    let mut questions = vec![empty_question(&nothing), empty_question(&empty_leaf)];
    // The smallest nonempty trees consist of a single leaf.
    for count in [1, 5] {
        let tree = soup_tree(rng, count, 1.5, count);
        questions.push(question_without_decoys(rng, tree, [12, 6], ray_from_around));
    }
    questions.push(linear_scan_control(rng));
    questions
}
