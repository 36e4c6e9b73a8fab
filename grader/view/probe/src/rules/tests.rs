use crate::messages::TestCounts;
use glam::{Vec3, vec3};
use protocol::{Ray, Tree};

use super::*;

/// Returns a tree with three leaves along x: leaf 1 at 0..1, leaf 2 at 2..3, and leaf 3 at 2..3 but
/// far above. Node 4 is the parent of 2 and 3.
fn tree() -> IndexedTree {
    let node = |min: Vec3, max, start, size, l, r| TreeNode::new(min, max, start, size, l, r);
    IndexedTree::new(Tree {
        nodes: vec![
            node(Vec3::ZERO, vec3(3.0, 9.0, 1.0), 0, 0, 1, 4),
            node(Vec3::ZERO, Vec3::ONE, 0, 1, 0, 0),
            node(vec3(2.0, 0.0, 0.0), vec3(3.0, 1.0, 1.0), 1, 1, 0, 0),
            node(vec3(2.0, 8.0, 0.0), vec3(3.0, 9.0, 1.0), 2, 1, 0, 0),
            node(vec3(2.0, 0.0, 0.0), vec3(3.0, 9.0, 1.0), 0, 0, 2, 3),
        ],
        root: 0,
        order: vec![0, 1, 2],
    })
}

/// Parses a test: `b2` tests the box of node 2, `p1` tests primitive 1 without hitting it, and
/// `p1:3.5` tests primitive 1 and hits it at distance 3.5.
fn test(text: &str) -> Test {
    let (kind, rest) = text.split_at(1);
    let (number, distance) = rest.split_once(':').unwrap_or((rest, ""));
    let number: u32 = number.parse().unwrap();
    if kind == "b" {
        let node = tree().tree.nodes[number as usize];
        return Test::Box {
            min: node.min,
            max: node.max,
            times: Interval::AHEAD,
            inside: None,
            address: 0,
        };
    }
    Test::Primitive {
        shape: number,
        range: Interval::AHEAD,
        distance: distance.parse().ok(),
    }
}

/// Returns the rules broken by these tests for a ray along x, each with the node that shouldn't
/// have been entered.
fn broken(tests: &str) -> Vec<(Rule, u32)> {
    let ray = RecordedRay {
        ray: Ray::new(vec3(-1.0, 0.5, 0.5), Vec3::X),
        hit: None,
        tests: tests.split(' ').map(test).collect(),
        counts: TestCounts::default(),
        steps_before: 0,
    };
    let span = |min, max| Some(Interval::new(min, max));
    let spans = [
        (1, span(1.0, 2.0)),
        (2, span(3.0, 4.0)),
        (3, None),
        (4, span(3.0, 4.0)),
    ];
    let both = |inside| NodeSpan {
        inside,
        inside_larger: inside,
    };
    let spans = spans
        .into_iter()
        .map(|(node, inside)| (node, both(inside)))
        .collect();
    let rows = rows(&ray, &tree(), None);
    let found = broken_rules(&ray, &rows, &tree(), &spans);
    found.into_iter().flatten().collect()
}

#[test]
fn a_correct_traversal_breaks_no_rule() {
    assert_eq!(broken("b1 b4 p0 b2 b3 p1:3.5"), []);
    assert_eq!(broken("b1 b4 p0:1.5"), [], "pruned");
    assert_eq!(broken("p0:-5.0 b2 p1"), [], "a hit outside the range");
}

#[test]
fn each_rule_is_found_when_it_is_broken() {
    assert_eq!(broken("b1 b4 p0 b2 p2"), [(Rule::MissedBox, 3)]);
    let beyond = Rule::BeyondClosestHit;
    assert_eq!(broken("p0:1.5 b2 p1"), [(beyond, 4), (beyond, 2)]);
    let farther = [(Rule::FartherChildFirst, 4)];
    assert_eq!(broken("b1 b4 b2 p1 p0"), farther);
}

#[test]
fn addresses_tell_nodes_with_equal_boxes_apart() {
    let node = |max: f32, l, r| TreeNode::new(Vec3::ZERO, Vec3::splat(max), 0, 1, l, r);
    let tree = IndexedTree::new(Tree {
        nodes: vec![
            node(2.0, 1, 2),
            node(2.0, 3, 4),
            node(1.0, 0, 0),
            node(2.0, 0, 0),
            node(0.5, 0, 0),
        ],
        root: 0,
        order: vec![0],
    });
    let test = |max: f32, address| Test::Box {
        min: Vec3::ZERO,
        max: Vec3::splat(max),
        times: Interval::AHEAD,
        inside: None,
        address,
    };
    let tests = [test(1.0, 1096), test(0.5, 1192), test(2.0, 1048)];
    let addresses = NodeAddresses::find(tests.iter(), &tree).unwrap();
    let at = [1048, 1050, 1000, 999, 0].map(|address| addresses.node_at(address));
    assert_eq!(at, [Some(1), None, Some(0), None, None]);
    let copied = [test(1.0, 500), test(0.5, 500), test(2.0, 500)];
    assert_eq!(NodeAddresses::find(copied.iter(), &tree), None);
    assert_eq!(NodeAddresses::find(tests[..1].iter(), &tree), None);
}
