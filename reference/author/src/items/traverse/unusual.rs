//! Roots elsewhere, and none at all.

use glam::Vec3;
use grader::exam::{Asked, Item};
use protocol::{Ray, Shape, TreeNode};

use super::{FIRST_ORPHAN, asked, from_around, honest, item, rays, soup_tree};
use crate::items::ray;
use crate::oracle::Beam;
use crate::seed::{Draw, Seed};
use crate::tree::{RootPlace, Tree, trap};

pub(super) fn root(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.root");
    let question = |place: RootPlace| {
        let tree = soup_tree(&mut draw, 20, 0.9, 1);
        let rays = rays(&mut draw, &tree, [10, 4], from_around);
        let inner = if place == RootPlace::First {
            place
        } else {
            RootPlace::Middle
        };
        let tree = tree.rearranged(&mut draw, inner);
        asked(&beside_others(&mut draw, tree, &rays, place), rays)
    };
    let mut draw = seed.draw("traverse.root.leaf_in_front");
    let leaf_in_front = with_a_leaf_in_front(&mut draw);
    item(
        "root",
        1,
        [
            "the walk begins at root, wherever that is",
            "The root need be neither the first node nor the last: Bvh::root says where it stands, \
             and there may be nodes that are no part of the tree.",
        ],
        [RootPlace::First, RootPlace::Middle, RootPlace::Last]
            .map(question)
            .into_iter()
            .chain([leaf_in_front])
            .collect(),
    )
}

/// A question about a tree whose first node is a leaf, with what one of the rays hits: a child may
/// stand at 0 as well.
fn with_a_leaf_in_front(draw: &mut Draw) -> Asked {
    let tree = soup_tree(draw, 20, 0.9, 1);
    let rays = rays(draw, &tree, [10, 4], from_around);
    let mut tree = tree.rearranged(draw, RootPlace::Last);
    let mut hits = rays.iter().map(Beam::from);
    let leaf = hits.find_map(|beam| tree.leaf_of_hit(&beam));
    tree.swap_nodes(0, leaf.expect("some rays hit something"));
    asked(&tree, rays)
}

/// Adds two trees, over primitives right before the rays, that do not hang below the root. Their
/// own roots stand at those ends of the list where the tree's does not.
fn beside_others(draw: &mut Draw, mut tree: Tree, rays: &[Ray], place: RootPlace) -> Tree {
    let mut decoy = |tree: &mut Tree, nearness: f64| {
        let facets = rays.iter().enumerate().map(|(i, ray)| {
            let material = FIRST_ORPHAN + tree.shapes.len() as u32 + i as u32;
            trap::facet(draw, ray, nearness, 0.1, material)
        });
        let mut left: Vec<Shape> = facets.collect();
        let right = left.split_off(left.len() / 2);
        let l = tree.leaf(left);
        let r = tree.leaf(right);
        tree.fork(l, r)
    };
    let first = decoy(&mut tree, 0.4);
    if place != RootPlace::First {
        tree.swap_nodes(0, first);
    }
    // The last node added is the last.
    let last = decoy(&mut tree, 0.6);
    if place == RootPlace::Last {
        tree.swap_nodes(tree.root, last);
    }
    tree
}

pub(super) fn no_nodes(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.no_nodes");
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
    let toward = |draw: &mut Draw| {
        let target = draw.point(0.8);
        ray(target + 4.0 * draw.direction(), target)
    };
    let mut ask = |tree: &Tree| asked(tree, (0..8).map(|_| toward(&mut draw)).collect());
    let empty = [ask(&nothing), ask(&empty_leaf)];
    let tree = soup_tree(&mut draw, 12, 0.9, 1);
    let control = honest(&mut draw, tree, [8, 4], from_around);
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
