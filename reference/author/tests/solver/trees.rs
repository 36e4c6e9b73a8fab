//! Trees that people build: right ones but for their cost, and wrong ones.

use author::tree::plant;
use protocol::{Shape, Tree, TreeNode};

pub type BuildTree = fn(&[Shape], usize) -> Tree;

/// Every node by halves.
pub fn halves(shapes: &[Shape], max_leaf_size: usize) -> Tree {
    if shapes.is_empty() {
        return Tree::default();
    }
    let tree = plant::halves(shapes.to_vec(), max_leaf_size);
    Tree {
        nodes: tree.nodes,
        root: tree.root as u32,
        order: tree.shapes.iter().map(Shape::material).collect(),
    }
}

fn but(shapes: &[Shape], max_leaf_size: usize, change: impl FnOnce(&mut Tree)) -> Tree {
    let mut tree = halves(shapes, max_leaf_size);
    change(&mut tree);
    tree
}

fn leaves(tree: &mut Tree) -> impl Iterator<Item = &mut TreeNode> {
    tree.nodes.iter_mut().filter(|node| node.is_leaf())
}

pub const WRONG_TREES: [(&str, BuildTree); 9] = [
    ("no nodes", |shapes, _| Tree {
        order: shapes.iter().map(Shape::material).collect(),
        ..Tree::default()
    }),
    ("nothing at all", |_, _| Tree::default()),
    ("all in one leaf", |shapes, _| {
        halves(shapes, shapes.len().max(1))
    }),
    ("leaves twice as large", |shapes, most| {
        halves(shapes, 2 * most)
    }),
    ("leaves of one", |shapes, _| halves(shapes, 1)),
    ("leaves below the limit", |shapes, most| {
        halves(shapes, (most - 1).max(1))
    }),
    ("boxes from the origin", |shapes, most| {
        but(shapes, most, |tree| {
            for node in &mut tree.nodes {
                node.min = node.min.min(glam::Vec3::ZERO);
                node.max = node.max.max(glam::Vec3::ZERO);
            }
        })
    }),
    ("boxes around centers", |shapes, most| {
        but(shapes, most, |tree| {
            for node in leaves(tree) {
                let middle = 0.5 * (node.min + node.max);
                (node.min, node.max) = (node.min.lerp(middle, 0.5), node.max.lerp(middle, 0.5));
            }
        })
    }),
    ("a primitive lost", |shapes, most| {
        but(shapes, most, |tree| {
            if let Some(leaf) = leaves(tree).find(|leaf| leaf.size > 0) {
                leaf.size -= 1;
            }
        })
    }),
];
