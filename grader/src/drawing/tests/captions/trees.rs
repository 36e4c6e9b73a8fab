//! Tests of the captions for trees that were built or traversed.

use glam::vec3;
use judging::drawing_data::{DrawingData, TraversalStep};
use judging::exam::{ExamQuestion, ExpectedRows, Key, TreeCheck};
use protocol::{Answer, ElementOutcome, Geometry, Interval, Question, Trace, Tree, TreeNode};

use super::{ahead, ball, caption, captions, hits, trace};

fn node(x: [f32; 2], leaf: Option<[u32; 2]>, [l, r]: [u32; 2]) -> TreeNode {
    let [start, size] = leaf.unwrap_or_default();
    TreeNode {
        min: vec3(x[0], -1.0, -6.0),
        max: vec3(x[1], 1.0, -4.0),
        start,
        size,
        l,
        r,
    }
}

/// Returns a tree over two spheres that are far apart, with one leaf for each.
fn two_leaf_tree() -> Vec<TreeNode> {
    vec![
        node([-1.0, 11.0], None, [1, 2]),
        node([-1.0, 1.0], Some([0, 1]), [0, 0]),
        node([9.0, 11.0], Some([1, 1]), [0, 0]),
    ]
}

/// Returns the captions for built trees.
pub(super) fn built_trees() -> String {
    let exam_question = |check: Option<TreeCheck>, max_leaf_size, sweep_cost| {
        let question = Question::Build {
            shapes: vec![ball(0.0, 0), ball(10.0, 1)],
            max_leaf_size,
        };
        let checks = check.into_iter().collect();
        ExamQuestion::new(question, Key::Tree { checks, sweep_cost })
    };
    let tree = |nodes: Vec<TreeNode>| {
        let order = vec![0, 1];
        Answer::Tree(ElementOutcome::Value(Tree {
            nodes,
            root: 0,
            order,
        }))
    };
    let with = |index: usize, node: TreeNode| {
        let mut nodes = two_leaf_tree();
        nodes[index] = node;
        tree(nodes)
    };
    let two_leaves = || tree(two_leaf_tree());
    let one_leaf = || tree(vec![node([-1.0, 11.0], Some([0, 2]), [0, 0])]);
    let half = with(2, node([9.0, 10.0], Some([1, 1]), [0, 0]));
    let wide = with(2, node([9.0, 12.0], Some([1, 1]), [0, 0]));
    let twice = with(2, node([-1.0, 1.0], Some([0, 1]), [0, 0]));
    let circle = with(2, node([9.0, 11.0], None, [0, 1]));
    let lines = [
        (Some(TreeCheck::Contains), 1, None, half),
        (Some(TreeCheck::Tight), 1, None, wide),
        (Some(TreeCheck::Partition), 1, None, twice),
        (Some(TreeCheck::LeafSize), 1, None, one_leaf()),
        (Some(TreeCheck::Split), 1, None, one_leaf()),
        (Some(TreeCheck::Stops), 2, None, two_leaves()),
        (None, 1, Some(1.0), two_leaves()),
        (None, 1, None, circle),
    ]
    .map(|(check, most, sweep, tree)| caption(&exam_question(check, most, sweep), tree));
    lines.join("\n")
}

/// Returns the captions for traversals.
pub(super) fn traversals() -> String {
    // The ray misses the box of the right leaf, whose second primitive is a decoy.
    let mut nodes = two_leaf_tree();
    nodes[2].size = 2;
    let span = |min, max| Some(Interval::new(min, max));
    let exam_question = |third: Option<Interval>| {
        let step = |node, is_entered, span| TraversalStep {
            node,
            is_entered,
            span,
        };
        ExamQuestion {
            question: Question::hits(
                Geometry::Tree {
                    shapes: (0..4).map(|i| ball(10.0 * i as f32, i)).collect(),
                    nodes: nodes.clone(),
                    root: 0,
                },
                vec![ahead(0.0, f32::INFINITY)],
            ),
            key: Key::table(
                &["distance"],
                ExpectedRows::Hits(vec![Some(Trace {
                    shape: 0,
                    ..trace(4.0)
                })]),
            ),
            drawing_data: DrawingData::Traversals(vec![vec![
                step(0, true, span(4.0, 6.0)),
                step(1, true, span(4.0, 6.0)),
                step(2, false, third),
            ]]),
        }
    };
    let answer = |shape, distance| {
        hits(Some(Trace {
            shape,
            ..trace(distance)
        }))
    };
    let lines = [
        captions(
            &exam_question(None),
            [answer(2, 1.0), answer(3, 1.0), answer(0, 6.0), hits(None)],
        ),
        captions(
            &exam_question(span(5.0, 7.0)),
            [answer(2, 1.0), answer(2, 6.0)],
        ),
    ];
    lines.join("\n")
}
