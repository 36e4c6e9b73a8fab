use glam::{Vec3, vec3};
use protocol::TreeNode;

use super::*;

/// Returns spheres of diameter 1 in a row. The distance between neighbouring centres is 2.
pub(crate) fn row(count: u32) -> Vec<Shape> {
    let ball = |i| Shape::Sphere {
        center: vec3(2.0 * i as f32, 0.0, 0.0),
        radius: 0.5,
        shape: i,
    };
    (0..count).map(ball).collect()
}

fn node(first: u32, last: u32, size: u32, l: u32, r: u32) -> TreeNode {
    TreeNode {
        min: vec3(2.0 * first as f32 - 0.5, -0.5, -0.5),
        max: vec3(2.0 * last as f32 + 0.5, 0.5, 0.5),
        start: first,
        size,
        l,
        r,
    }
}

/// Returns a leaf with the spheres from `first` to `last`.
fn leaf(first: u32, last: u32) -> TreeNode {
    node(first, last, last - first + 1, 0, 0)
}

/// Returns a tree with these nodes over this many spheres. The first node is the root, and the
/// spheres are listed in order.
fn tree_of(nodes: Vec<TreeNode>, count: u32) -> Tree {
    Tree {
        nodes,
        root: 0,
        order: (0..count).collect(),
    }
}

/// Returns a tree over four spheres, with two in each leaf. The root is in the middle of the list
/// of nodes.
pub(crate) fn valid_tree() -> Tree {
    Tree {
        root: 1,
        ..tree_of(vec![leaf(0, 1), node(0, 3, 0, 0, 2), leaf(2, 3)], 4)
    }
}

/// Judges a tree over a row of spheres.
fn judge(
    checks: &[TreeCheck],
    sweep_cost: Option<f64>,
    count: u32,
    max_leaf_size: u32,
    tree: Tree,
) -> Judgement {
    let criteria = TreeCriteria {
        checks,
        sweep_cost,
        shapes: &row(count),
        max_leaf_size,
    };
    let answer = &ElementOutcome::Value(tree);
    let built = TreeAnswer { criteria, answer };
    let judgement = built.judge();
    let mut measured = built.measure().into_iter();
    let is_right = measured.all(|measured| measured.deciding_deviation().is_right());
    assert_eq!(is_right, judgement.credit == Credit::FULL);
    judgement
}

pub(crate) const ALL_CHECKS: [TreeCheck; 5] = [
    TreeCheck::Partition,
    TreeCheck::Contains,
    TreeCheck::Tight,
    TreeCheck::LeafSize,
    TreeCheck::Stops,
];

/// Returns the property that is wrong in a tree over four spheres, and the submission's value for
/// it.
fn defect_of(tree: Tree) -> (String, String) {
    let judgement = judge(&ALL_CHECKS, None, 4, 2, tree);
    match judgement.failure.map(|failure| failure.kind) {
        None => ("right".to_owned(), String::new()),
        Some(FailureKind::Wrong { what, got, .. }) => (what, got),
        Some(FailureKind::Uneven { .. } | FailureKind::Panicked(_) | FailureKind::Protocol(_)) => {
            unreachable!("the answer is a tree")
        }
    }
}

#[test]
fn each_check_finds_its_defect() {
    type Change = fn(&mut Tree);
    let changes: [(&str, Change); 15] = [
        ("right", |_| {}),
        ("leaves", |tree| tree.order = vec![0, 1, 2, 2]),
        ("leaves", |tree| tree.order = vec![0, 1, 2, 9]),
        ("leaves", |tree| tree.nodes[2].size = 3),
        ("leaves", |tree| tree.nodes[2].size = 1),
        ("box too small", |tree| tree.nodes[1].max.x = 3.0),
        ("box too large", |tree| tree.nodes[0].min.y = -0.6),
        ("box too small", |tree| tree.nodes[0].min.y = f32::NAN),
        ("box too large", |tree| {
            tree.nodes[0].min.y = f32::NEG_INFINITY
        }),
        ("child r", |tree| tree.nodes[1].r = 7),
        ("nodes", |tree| tree.nodes[1].r = 1),
        ("root", |tree| tree.root = 3),
        ("nodes", |tree| tree.nodes.clear()),
        ("leaf size", |tree| tree.nodes[1] = leaf(0, 3)),
        ("right", |tree| tree.nodes[1].start = 9),
    ];
    for (expected, change) in changes {
        let mut tree = valid_tree();
        change(&mut tree);
        assert_eq!(defect_of(tree).0, expected);
    }
}

#[test]
fn a_tree_may_be_deep_on_either_side() {
    for mirrored in [false, true] {
        let fork = |first: u32, l: u32, r: u32| {
            let (l, r) = if mirrored { (r, l) } else { (l, r) };
            node(first, 3, 0, l, r)
        };
        let forks = [fork(0, 1, 2), fork(1, 3, 4), fork(2, 5, 6)];
        let leaves = [0, 1, 2, 3].map(|i| leaf(i, i));
        let nodes = forks
            .iter()
            .zip(&leaves)
            .flat_map(|(fork, leaf)| [*fork, *leaf]);
        let nodes = nodes.chain([leaves[3]]).collect();
        let judgement = judge(&ALL_CHECKS, None, 4, 1, tree_of(nodes, 4));
        assert_eq!(judgement.credit, Credit::FULL, "{judgement:?}");
    }
}

#[test]
fn counting_stops_when_leaves_list_too_many_primitives() {
    // A chain of nodes, each with a leaf that lists all of a long `order`.
    let (links, listed) = (2_000, 200_000);
    let link = |i: u32| {
        [
            node(0, 3, 0, 2 * i + 1, 2 * i + 2),
            node(0, 3, listed, 0, 0),
        ]
    };
    let mut nodes: Vec<TreeNode> = (0..links).flat_map(link).collect();
    nodes.push(node(0, 3, listed, 0, 0));
    let tree = Tree {
        order: vec![0; listed as usize],
        ..tree_of(nodes, 0)
    };
    assert_eq!(
        defect_of(tree).1,
        "leaves that hold more than 4096 primitives in all"
    );
    // A single leaf that lists exactly the maximum number of primitives is read completely.
    let full = Tree {
        order: vec![0; 4096],
        ..tree_of(vec![node(0, 3, 4096, 0, 0)], 0)
    };
    assert!(reached_nodes(&row(4), &full).is_ok());
}

#[test]
fn a_leaf_with_half_of_the_primitives_is_not_split() {
    let credit = |count: u32, nodes: Vec<TreeNode>| {
        judge(&[TreeCheck::Split], None, count, 1, tree_of(nodes, count)).credit
    };
    assert_eq!(credit(1, vec![leaf(0, 0)]), Credit::FULL);
    assert_eq!(credit(4, vec![leaf(0, 3)]), Credit::NONE);
    let fork = node(0, 4, 0, 1, 2);
    let half = vec![fork, leaf(0, 1), leaf(2, 3)];
    assert_eq!(credit(4, half), Credit::NONE);
    let half = vec![node(0, 5, 0, 1, 2), leaf(0, 2), leaf(3, 5)];
    assert_eq!(credit(6, half), Credit::NONE);
    // Some leaves contain more than one primitive, but each contains less than half of them.
    let right = node(2, 4, 0, 3, 4);
    let thirds = vec![fork, leaf(0, 1), right, leaf(2, 3), leaf(4, 4)];
    assert_eq!(credit(5, thirds), Credit::FULL);
}

#[test]
fn reports_a_node_that_should_be_a_leaf() {
    let judgement = judge(&[TreeCheck::Stops], None, 4, 4, valid_tree());
    assert_eq!(judgement.credit, Credit::NONE);
}

#[test]
fn each_node_has_a_level_and_the_primitives_to_its_left() {
    let mut tree = valid_tree();
    tree.nodes[2] = node(2, 3, 0, 3, 4);
    tree.nodes
        .extend([node(2, 2, 1, 0, 0), node(3, 3, 1, 0, 0)]);
    let nodes = reached_nodes(&row(4), &tree).expect("the tree is valid");
    let places: Vec<(u32, u32, usize)> = nodes
        .iter()
        .map(|node| (node.index, node.level, node.start))
        .collect();
    let expected = [(1, 0, 0), (2, 1, 2), (4, 2, 3), (3, 2, 2), (0, 1, 0)];
    assert_eq!(places, expected);
}

#[test]
fn cost_matches_a_hand_calculation() {
    // One box of 7×1×1 (area 30) and two of 3×1×1 (area 14): 1 + 2 · 2 · 14/30.
    let tree = valid_tree();
    let nodes = reached_nodes(&row(4), &tree).expect("the tree is valid");
    let by_hand = 1.0 + 4.0 * 14.0 / 30.0;
    assert!((cost(&nodes) - by_hand).abs() < 1e-12);

    let credit = |ratio: f64| {
        let sweep = Some(by_hand / ratio);
        judge(&ALL_CHECKS, sweep, 4, 2, valid_tree()).credit
    };
    assert_eq!(credit(1.11), Credit::FULL);
    assert_eq!(credit(1.13), Credit::HALF);
    assert_eq!(credit(1.26), Credit::NONE);

    // The report also says which split the root has, since the cost says nothing about it.
    let cheaper = Some(by_hand / 2.0);
    let failure = judge(&ALL_CHECKS, cheaper, 4, 2, valid_tree()).failure;
    let Some(FailureKind::Wrong { got, .. }) = failure.map(|failure| failure.kind) else {
        panic!("the cost is wrong")
    };
    assert!(
        got.starts_with("2.00 times")
            && got.ends_with("(the root splits 4 primitives into 2 and 2)"),
        "{got}"
    );
}

#[test]
fn an_empty_leaf_costs_nothing_but_its_parent_does() {
    // The left leaf of the valid tree becomes the child of a node whose other child is empty.
    let mut tree = valid_tree();
    let empty = TreeNode::new(Vec3::INFINITY, Vec3::NEG_INFINITY, 0, 0, 4, 4);
    tree.nodes.extend([leaf(0, 1), empty]);
    tree.nodes[0] = node(0, 1, 0, 3, 4);
    let nodes = reached_nodes(&row(4), &tree).expect("the tree is valid");
    let by_hand = 1.0 + (1.0 + 2.0 + 2.0) * 14.0 / 30.0;
    assert!((cost(&nodes) - by_hand).abs() < 1e-12);

    let empty = tree_of(
        vec![TreeNode {
            l: 0,
            r: 0,
            ..empty
        }],
        0,
    );
    let nodes = reached_nodes(&[], &empty).expect("the tree is valid");
    assert_eq!(cost(&nodes), 0.0);
}

#[test]
fn an_empty_tree_has_no_node_or_one_empty_leaf() {
    let empty = |nodes| judge(&ALL_CHECKS, None, 0, 1, tree_of(nodes, 0)).credit;
    assert_eq!(empty(Vec::new()), Credit::FULL);
    let leaf = TreeNode::new(Vec3::INFINITY, Vec3::NEG_INFINITY, 0, 0, 0, 0);
    assert_eq!(empty(vec![leaf]), Credit::FULL);
    assert_eq!(empty(vec![TreeNode { size: 1, ..leaf }]), Credit::NONE);
}

#[test]
fn measures_box_excess_and_cost() {
    let measured = |tree: Tree, sweep_cost| {
        let criteria = TreeCriteria {
            checks: &ALL_CHECKS,
            sweep_cost,
            shapes: &row(4),
            max_leaf_size: 2,
        };
        let answer = &ElementOutcome::Value(tree);
        TreeAnswer { criteria, answer }.measure()
    };
    let value = |measured: &[Measurement], threshold| {
        let mut offs = measured.iter().map(|measured| measured.deviation);
        let found = offs.find(|off| off.threshold == Some(threshold));
        found.expect("the quantity is measured").value
    };

    let mut loose = valid_tree();
    loose.nodes[0].min.x -= 3e-4;
    let diagonal = f64::from(11.0_f32).sqrt();
    let found = value(&measured(loose, None), Threshold::BoxTooLarge);
    assert!((found - 3.0 / diagonal).abs() < 0.01, "{found}");

    let by_hand = 1.0 + 4.0 * 14.0 / 30.0;
    let found = value(
        &measured(valid_tree(), Some(by_hand / 1.06)),
        Threshold::SahCost,
    );
    assert!((found - 0.5).abs() < 1e-9, "{found}");
}

#[test]
fn boxes_are_judged_relative_to_their_diagonals() {
    let is_right = |excess: f64| {
        let mut tree = valid_tree();
        tree.nodes[1].max.x += excess as f32;
        defect_of(tree).0 == "right"
    };
    // The diagonal is 7.1.
    assert!(is_right(5.0 * TIGHT_TOLERANCE) && !is_right(9.0 * TIGHT_TOLERANCE));
    assert!(is_right(-5.0 * CONTAIN_TOLERANCE) && !is_right(-9.0 * CONTAIN_TOLERANCE));
}
