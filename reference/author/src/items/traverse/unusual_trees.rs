//! Roots elsewhere, and none at all.

use glam::Vec3;
use grader::exam::{ExamQuestion, Item};
use protocol::{Ray, Shape, TreeNode};

use super::{
    FIRST_UNREFERENCED, item, question_without_decoys, ray_from_around, soup_tree,
    traversal_question, unambiguous_rays,
};
use crate::items::ray;
use crate::oracle::Ray64;
use crate::seed::{Rng, Seed};
use crate::tree::{RootPosition, Tree, decoy};

pub(super) fn root(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.root");
    let question = |place: RootPosition| {
        let tree = soup_tree(&mut draw, 20, 0.9, 1);
        let rays = unambiguous_rays(&mut draw, &tree, [10, 4], ray_from_around);
        let inner = if place == RootPosition::First {
            place
        } else {
            RootPosition::Middle
        };
        let tree = tree.with_nodes_shuffled(&mut draw, inner);
        traversal_question(&with_detached_subtrees(&mut draw, tree, &rays, place), rays)
    };
    let mut draw = seed.rng("traverse.root.leaf_in_front");
    let leaf_in_front = question_with_a_leaf_in_front(&mut draw);
    item(
        "root",
        1,
        [
            "the walk begins at root, wherever that is",
            "The root need be neither the first node nor the last: Bvh::root says where it stands, \
             and there may be nodes that are no part of the tree.",
        ],
        [
            RootPosition::First,
            RootPosition::Middle,
            RootPosition::Last,
        ]
        .map(question)
        .into_iter()
        .chain([leaf_in_front])
        .collect(),
    )
}

/// A question about a tree whose first node is a leaf, with what one of the rays hits: a child may
/// stand at 0 as well.
fn question_with_a_leaf_in_front(draw: &mut Rng) -> ExamQuestion {
    let tree = soup_tree(draw, 20, 0.9, 1);
    let rays = unambiguous_rays(draw, &tree, [10, 4], ray_from_around);
    let mut tree = tree.with_nodes_shuffled(draw, RootPosition::Last);
    let mut hits = rays.iter().map(Ray64::from);
    let leaf = hits.find_map(|beam| tree.leaf_of_hit(&beam));
    tree.swap_nodes(0, leaf.expect("some rays hit something"));
    traversal_question(&tree, rays)
}

/// Adds two trees, over primitives right before the rays, that do not hang below the root. Their
/// own roots stand at those ends of the list where the tree's does not.
fn with_detached_subtrees(
    draw: &mut Rng,
    mut tree: Tree,
    rays: &[Ray],
    place: RootPosition,
) -> Tree {
    let mut decoy = |tree: &mut Tree, nearness: f64| {
        let facets = rays.iter().enumerate().map(|(i, ray)| {
            let material = FIRST_UNREFERENCED + tree.shapes.len() as u32 + i as u32;
            decoy::triangle_across(draw, ray, nearness, 0.1, material)
        });
        let mut left: Vec<Shape> = facets.collect();
        let right = left.split_off(left.len() / 2);
        let l = tree.add_leaf(left);
        let r = tree.add_leaf(right);
        tree.add_interior(l, r)
    };
    let first = decoy(&mut tree, 0.4);
    if place != RootPosition::First {
        tree.swap_nodes(0, first);
    }
    // The last node added is the last.
    let last = decoy(&mut tree, 0.6);
    if place == RootPosition::Last {
        tree.swap_nodes(tree.root, last);
    }
    tree
}

pub(super) fn no_nodes(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.no_nodes");
    let nothing = Tree {
        shapes: Vec::new(),
        nodes: Vec::new(),
        root: 0,
    };
    let mut empty_leaf = nothing.clone();
    empty_leaf.nodes.push(TreeNode {
        min: Vec3::NEG_ONE,
        max: Vec3::ONE,
        start: 0,
        size: 0,
        l: 0,
        r: 0,
    });
    let toward = |draw: &mut Rng| {
        let target = draw.point(0.8);
        ray(target + 4.0 * draw.direction(), target)
    };
    let mut ask =
        |tree: &Tree| traversal_question(tree, (0..8).map(|_| toward(&mut draw)).collect());
    let empty = [ask(&nothing), ask(&empty_leaf)];
    let tree = soup_tree(&mut draw, 12, 0.9, 1);
    let control = question_without_decoys(&mut draw, tree, [8, 4], ray_from_around);
    item(
        "no_nodes",
        1,
        [
            "a tree that holds nothing is hit nowhere",
            "Without nodes there is none at root: look before you take it.",
        ],
        empty.into_iter().chain([control]).collect(),
    )
}
