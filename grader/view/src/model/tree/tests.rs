use protocol::{Shape, Tree};

use super::*;

fn model_of(tree: Tree) -> TreeModel {
    let sphere = |shape, center, radius| Shape::Sphere {
        center: Vec3::splat(center),
        radius,
        shape,
    };
    let shapes = [
        sphere(9, 0.5, 0.5),
        sphere(8, 1.5, 0.5),
        sphere(7, 1.5, 0.5),
        sphere(6, 3.0, 1.0),
    ];
    let criteria = TreeCriteria {
        checks: &CHECKS,
        sweep_cost: None,
        shapes: &shapes,
        max_leaf_size: 2,
    };
    TreeModel::new(IndexedTree::new(tree), &criteria)
}

/// Returns a tree whose root has two children: an interior node, whose children contain 1 and 2
/// primitives, and a leaf with 1 primitive.
fn tree() -> Tree {
    let node = |low: f32, high: f32, start, size, l, r| {
        TreeNode::new(Vec3::splat(low), Vec3::splat(high), start, size, l, r)
    };
    Tree {
        nodes: vec![
            node(0.0, 1.0, 0, 1, 0, 0),
            node(0.0, 2.0, 0, 0, 0, 2),
            node(1.0, 2.0, 1, 2, 0, 0),
            node(0.0, 4.0, 0, 0, 1, 4),
            node(2.0, 4.0, 3, 1, 0, 0),
        ],
        root: 3,
        order: vec![9, 8, 7, 6],
    }
}

#[test]
fn levels_counts_and_costs_follow_from_the_tree() {
    let model = model_of(tree());
    assert_eq!(model.index.levels(), 3);
    let info = model.info(1).unwrap();
    assert_eq!((info.level, info.primitives, info.leaf), (1, 3, false));
    assert_eq!((info.parent, info.children), (Some(3), Some([0, 2])));
    assert_eq!(
        (info.area, info.cost, info.overlap),
        (0.25, 0.25, Some(0.5))
    );
    let leaf = model.info(2).unwrap();
    assert_eq!((leaf.level, leaf.primitives, leaf.cost), (2, 2, 0.125));
    // 1 + 1/4 for the interior nodes, 1/16 + 2/16 + 1/4 for the leaves.
    assert_eq!(model.total_cost(), 1.0 + 0.25 + 0.0625 + 0.125 + 0.25);
    assert_eq!(model.index.leaf_of(7), Some(2));
    assert_eq!(model.index.with_box(Vec3::ZERO, Vec3::splat(2.0)), [1]);
}

#[test]
fn a_level_lists_large_boxes_first() {
    let model = model_of(tree());
    let ids = |(nodes, count): (Vec<NodeInfo>, usize)| -> (Vec<u32>, usize) {
        (nodes.iter().map(|node| node.node).collect(), count)
    };
    assert_eq!(ids(model.at_level(1, false, 9)), (vec![1, 4], 2));
    assert_eq!(ids(model.at_level(1, true, 3)), (vec![1, 4, 0], 4));
    assert_eq!(model.worst(1)[0].node, 1);
}

#[test]
fn bars_are_beside_each_other() {
    let bars = model_of(tree()).strip(0.0);
    let of = |node| *bars.iter().find(|bar| bar.node == node).unwrap();
    assert_eq!((of(3).start, of(3).width), (0.0, 1.0));
    assert_eq!((of(2).start, of(2).width, of(2).level), (0.25, 0.5, 2));
    assert_eq!((of(4).start, of(4).width), (0.75, 0.25));
}

#[test]
fn of_narrow_bars_one_is_kept_for_each_width_that_can_be_seen() {
    let model = model_of(tree());
    let in_level = |narrowest, level| {
        let bars = model.strip(narrowest).into_iter();
        let starts = bars.filter(|bar| bar.level == level).map(|bar| bar.start);
        starts.collect::<Vec<f32>>()
    };
    assert_eq!(in_level(0.0, 2), in_level(0.2, 2));
    assert_eq!(in_level(0.3, 1), [0.0, 0.75], "each is seen");
    assert_eq!(in_level(0.9, 1), [0.0], "the second bar is not seen");
}

#[test]
fn invalid_trees_are_shown_as_far_as_they_are_trees() {
    let mut cyclic = tree();
    cyclic.nodes[1].r = 3;
    cyclic.nodes[3].r = 77;
    cyclic.nodes[0].size = 1000;
    let model = model_of(cyclic);
    assert_eq!(model.index.levels(), 3);
    assert_eq!(model.info(0).unwrap().primitives, 4);
    assert_eq!(model.info(2), None, "node 2 is not reached");
    assert!(!model_of(Tree::default()).index.has_nodes());
}

/// Returns a tree with `interior` interior nodes. The children of each are a leaf and the next
/// interior node. Every leaf contains `size` primitives, starting at `start`.
fn chain(interior: usize, start: u32, size: u32, primitives: u32) -> Tree {
    let leaf = |_| TreeNode {
        start,
        size,
        ..TreeNode::new(Vec3::ZERO, Vec3::ONE, 0, 0, 0, 0)
    };
    let inner = |i: usize| {
        TreeNode::new(
            Vec3::ZERO,
            Vec3::ONE,
            0,
            0,
            2 * i + 1,
            (2 * i + 2) % (2 * interior),
        )
    };
    let nodes = (0..interior).flat_map(|i| [inner(i), leaf(i)]);
    Tree {
        nodes: nodes.collect(),
        root: 0,
        order: (0..primitives).collect(),
    }
}

#[test]
fn a_million_levels_and_equal_leaves_take_no_longer_than_other_trees() {
    let started_at = std::time::Instant::now();
    for (interior, start, size, held) in [
        (1_000_000, 0, 1, 1),
        (100_000, 0, u32::MAX, 300_000),
        (1_000, u32::MAX, u32::MAX, 0),
        (1_000, 299_999, 7, 1),
    ] {
        // The last child is the root again: a cycle.
        let model = model_of(chain(interior, start, size, 300_000));
        assert_eq!(model.index.levels(), interior as u32 + 1);
        assert_eq!(model.index.count(1), held);
        assert_eq!(model.index.count(0), (interior as u32).saturating_mul(held));
        let in_leaves = (0..300_000).filter(|number| model.index.leaf_of(*number).is_some());
        assert_eq!(in_leaves.count(), held as usize);
        assert_eq!(model.index.with_box(Vec3::ZERO, Vec3::ONE).len(), 100);
        assert_eq!(model.at_level(0, true, 9).1, 2 * interior);
        assert_eq!(model.worst(9).len(), 9);
        assert!(model.strip(0.01).len() < 30_000);
    }
    // Quadratic code would take minutes.
    assert!(started_at.elapsed().as_secs() < 60);
}

#[test]
fn a_box_with_nan_or_infinity_is_found_like_others() {
    let mut odd = tree();
    odd.nodes[2].min = Vec3::NAN;
    odd.nodes[4].max = Vec3::INFINITY;
    let model = model_of(odd);
    assert_eq!(model.index.with_box(Vec3::NAN, Vec3::splat(2.0)), [2]);
    assert_eq!(model.index.with_box(Vec3::splat(2.0), Vec3::INFINITY), [4]);
    assert!(
        model.index.has_box(0, Vec3::ZERO, Vec3::ONE)
            && !model.index.has_box(1, Vec3::ZERO, Vec3::ONE)
    );
    assert_eq!(model.worst(9).len(), 4);
}
