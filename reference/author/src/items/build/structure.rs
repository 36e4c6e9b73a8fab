//! Items about properties that every tree must have.

use glam::DVec3;
use judging::exam::ExamQuestion;
use judging::exam::TreeCheck::{self, Contains, LeafSize, Partition, Stops, Tight};
use judging::symptom::Symptom;
use protocol::{Question, Shape};

use super::build_question;
use super::draw;
use super::draw::Arrangement::{
    self, DifferentSizes, FlatBoxes, Line, Outlier, Plane, Row, Scattered, WithoutArea,
};
use crate::domains::build::BuildCall;
use crate::items::transform::Transform;
use crate::items::{Declaration, groups, meshes};
use crate::seed::Rng;

/// The maximum number of primitives in most questions.
const MOST: usize = 130;

/// All arrangements of distinct primitives that don't share a common centre.
const ARRANGEMENTS: &[Arrangement] = &[
    Line,
    FlatBoxes,
    WithoutArea,
    Plane,
    Row,
    DifferentSizes,
    Outlier,
];

/// Returns `questions`, followed by questions about `count` random trees from the domain. The
/// primitives of these trees are in the given arrangements.
fn with_domain(
    mut questions: Vec<ExamQuestion>,
    rng: &mut Rng,
    checks: &[TreeCheck],
    (count, arrangements): (usize, &[Arrangement]),
    belongs: impl Fn(&BuildCall) -> bool,
) -> Vec<ExamQuestion> {
    let drawn = draw::questions(rng, checks, count, (arrangements, MOST), belongs);
    questions.extend(drawn);
    questions
}

/// Returns whether the tree must have nodes that aren't leaves.
fn is_split(call: &BuildCall) -> bool {
    call.shapes.len() > call.max_leaf_size as usize
}

/// Returns whether a leaf is too small to hold a third of the primitives.
fn is_in_small_leaves(call: &BuildCall) -> bool {
    call.shapes.len() > 3 * call.max_leaf_size as usize
}

/// For each pair of a triangle count and a maximum leaf size, creates a question about random
/// triangles of this size. Up to seven more triangles are added to each question. Every other
/// question is far from the origin.
fn soup_questions(
    rng: &mut Rng,
    checks: &[TreeCheck],
    size: f64,
    sizes: &[(usize, u32)],
) -> Vec<ExamQuestion> {
    let question = |(index, &(count, max_leaf_size)): (usize, &(usize, u32))| {
        let count = count + rng.index(8);
        let shapes = meshes::soup(rng, count, 3.0, size);
        let elsewhere = Transform::elsewhere(rng);
        let shapes = if index % 2 == 1 {
            elsewhere.shapes(&shapes)
        } else {
            shapes
        };
        build_question(checks, shapes, max_leaf_size)
    };
    sizes.iter().enumerate().map(question).collect()
}

/// Creates questions with the same number of spheres, the same box around all of them, and the same
/// maximum leaf size. In the second question, a sphere from the middle of the list is elsewhere
/// inside this box. In the third, the spheres in the middle of the list have different radii. In
/// the last, two of these spheres have swapped numbers.
fn moved_inside(rng: &mut Rng, checks: &[TreeCheck]) -> Vec<ExamQuestion> {
    let count = rng.integer(8, 40) as usize;
    let corners = [-3.0, 3.0].map(|at| meshes::sphere(DVec3::splat(at), 0.3));
    let moved = rng.vector(1.0, 2.5);
    let mut inside = rng.list(count - 1, |rng| meshes::sphere(rng.point(2.5), 0.2));
    let question = |inside: &[Shape]| {
        let [first, last] = corners;
        let spheres = std::iter::once(first).chain(inside.iter().copied());
        build_question(checks, spheres.chain([last]), 1)
    };
    let mut questions: Vec<ExamQuestion> = [moved, -moved]
        .map(|moved| {
            inside[count / 2] = meshes::sphere(moved, 0.2);
            question(&inside)
        })
        .to_vec();
    for shape in &mut inside {
        if let Shape::Sphere { radius, .. } = shape {
            *radius = rng.uniform(0.1, 0.4) as f32;
        }
    }
    questions.push(question(&inside));
    let mut exchanged = question(&inside);
    if let Question::Build { shapes, .. } = &mut exchanged.question {
        let numbers = [0, 2, 1].into_iter().chain(3..);
        *shapes = meshes::with_numbers(shapes.iter().copied(), numbers);
    }
    questions.push(exchanged);
    questions
}

/// Creates a question about several hundred spheres, where a leaf may contain all but one of them.
fn large_leaves(rng: &mut Rng, checks: &[TreeCheck]) -> ExamQuestion {
    let count = rng.integer(600, 760) as usize;
    let spheres = meshes::many_spheres(rng, count);
    build_question(checks, spheres, count as u32 - 1)
}

/// Creates a question about over 1,024 spheres, with a small maximum leaf size.
fn large(rng: &mut Rng, checks: &[TreeCheck]) -> ExamQuestion {
    let count = rng.integer(1030, 1400) as usize;
    let spheres = meshes::many_spheres(rng, count);
    build_question(checks, spheres, rng.integer(1, 3))
}

/// Creates questions about trees with many levels. Each sphere is so much nearer to the origin than
/// the previous one that it is best to split off one sphere at a time.
fn deep(rng: &mut Rng) -> Vec<ExamQuestion> {
    let question = |count: i32| {
        let mut scale = 900.0;
        let spheres = (0..count).map(|index| {
            let sphere = meshes::sphere(scale * rng.vector(0.8, 1.0), 0.01 * scale);
            scale /= (1.1 * f64::from(count - index).sqrt()).max(3.0);
            sphere
        });
        let spheres: Vec<_> = spheres.collect();
        build_question(&[LeafSize], rng.shuffled(spheres), 1)
    };
    [22, 24].map(question).to_vec()
}

pub(super) const PARTITION: Declaration = Declaration {
    id: "build.partition",
    points: 2,
    title: "every primitive is in exactly one leaf",
    look: "Return a tree whose root is nodes[root]. From there, l and r, which are indices into \
           nodes, lead to the leaves. A leaf holds the primitives start..start + size of the list \
           that you return, and every primitive is in exactly one leaf.",
    look_fits: &[Symptom::of("nodes"), Symptom::of("leaves")],
    section: "building.md#a-leaf-is-a-slice-of-the-list",
    tests: &["Every primitive is…"],
    questions: |rng| {
        let many = vec![large(rng, &[Partition]), large_leaves(rng, &[Partition])];
        let arrangements = (8, &[Scattered, WithoutArea, DifferentSizes, Line] as &[_]);
        with_domain(many, rng, &[Partition], arrangements, |call| {
            call.shapes.len() > 2
        })
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const CONTAINS: Declaration = Declaration {
    id: "build.contains",
    points: 2,
    title: "every box contains everything below it",
    look: "A node's box must completely enclose the boxes of all primitives below it. A leaf's \
           primitives are start..start + size in the list that you return: compare the leaf's box \
           with theirs, and every other box with those of the node's children.",
    look_fits: &[Symptom::of("box too small")],
    section: "building.md#the-contract",
    tests: &["The box of a node…"],
    questions: |rng| {
        let mut questions = vec![large(rng, &[Contains]), large_leaves(rng, &[Contains])];
        questions.extend(moved_inside(rng, &[Contains]));
        let arrangements = (7, &[WithoutArea, DifferentSizes, Line] as &[_]);
        with_domain(questions, rng, &[Contains], arrangements, |_| true)
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const TIGHT: Declaration = Declaration {
    id: "build.tight",
    title: "no box is larger than necessary",
    look: "A node's box is the union of its primitives' boxes, with nothing added. Does it start as \
           BBox::EMPTY, and not at the origin? Is it the node's own box, not its parent's? Do start \
           and size include all of its primitives?",
    look_fits: &[Symptom::of("box too large")],
    section: "building.md#start-each-box-empty",
    tests: &["The box of a node…"],
    questions: |rng| {
        let many = vec![large(rng, &[Tight]), large_leaves(rng, &[Tight])];
        let arrangements = (2 * ARRANGEMENTS.len() + 2, ARRANGEMENTS);
        with_domain(many, rng, &[Tight], arrangements, is_split)
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const LEAF_SIZE: Declaration = Declaration {
    id: "build.leaf_size",
    points: 2,
    title: "no leaf holds more than max_leaf_size primitives",
    look: "Split a node until it has at most max_leaf_size primitives, even if a leaf would be \
           cheaper according to the heuristic.",
    look_fits: &[Symptom::of("leaf size"), Symptom::less("splits")],
    section: "building.md#when-a-node-becomes-a-leaf",
    tests: &["A node is a leaf…"],
    questions: |rng| {
        let crowd = &mut rng.sequence("build.leaf_size.crowd");
        let crowd = build_question(&[LeafSize], meshes::soup(crowd, 100, 0.3, 2.5), 1);
        // The triangles are so large that a builder that only follows the heuristic makes some
        // leaves too large. The first question has so many triangles that some node is split at its
        // very last plane. In the crowd, the triangles are so close together that buckets over the
        // node's box don't separate them.
        let sizes = [(300, 1), (60, 2), (150, 4), (150, 8)];
        let mut questions = soup_questions(rng, &[LeafSize], 2.5, &sizes);
        questions.push(crowd);
        questions.push(large(rng, &[LeafSize]));
        questions.extend(deep(rng));
        let arrangements = (ARRANGEMENTS.len(), ARRANGEMENTS);
        with_domain(
            questions,
            rng,
            &[LeafSize],
            arrangements,
            is_in_small_leaves,
        )
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const STOPS: Declaration = Declaration {
    id: "build.stops",
    title: "a node with at most max_leaf_size primitives is a leaf",
    look: "A node is a leaf if and only if it has at most max_leaf_size primitives. This applies to every \
        node, including the root, and to every max_leaf_size.",
    look_fits: &[Symptom::of("leaf size"), Symptom::more("splits")],
    section: "building.md#when-a-node-becomes-a-leaf",
    tests: &["A node is a leaf…"],
    questions: |rng| {
        let checks = [Stops, LeafSize];
        let mut questions = soup_questions(rng, &[Stops], 0.2, &[(160, 8)]);
        questions.push(large(rng, &[Stops]));
        // The same primitives again, with a different maximum leaf size. The root is a node like
        // any other: one question has exactly as many primitives as fit into a leaf, and another
        // has one more.
        let small = rng.integer(5, 10) as usize;
        for (count, most) in [(small, 130), (1000, 2)] {
            let balls = rng.list(count, |rng| meshes::sphere(rng.point(3.0), 0.1));
            let fits = count as u32;
            for max_leaf_size in [fits, fits - 1, fits + 1].into_iter().take(most) {
                questions.push(build_question(&checks, balls.clone(), max_leaf_size));
            }
        }
        let arrangements = (2 * ARRANGEMENTS.len(), ARRANGEMENTS);
        with_domain(questions, rng, &checks, arrangements, |call| {
            call.shapes.len() > 4
        })
    },
    ..Declaration::in_group(groups::TREES)
};
