//! Items about properties that every tree must have.

use judging::exam::ExamQuestion;
use judging::exam::TreeCheck::{self, Contains, LeafSize, Partition, Stops, Tight};

use super::build_question;
use super::draw::Arrangement::{DifferentSizes, FlatBoxes, Scattered, WithoutArea};
use super::draw::{self, Arrangement};
use crate::items::place::Place;
use crate::items::{Declaration, groups, meshes};
use crate::seed::Rng;

/// The largest number of primitives of which there are many questions.
const MOST: usize = 130;

/// Draws questions from the domain about scattered primitives, and others in these arrangements, in
/// addition to those that are given.
fn with_domain(
    mut questions: Vec<ExamQuestion>,
    rng: &mut Rng,
    checks: &[TreeCheck],
    count: usize,
    arrangements: &[Arrangement],
) -> Vec<ExamQuestion> {
    let drawn = draw::questions(rng, checks, count, (arrangements, MOST), |_| true);
    questions.extend(drawn);
    questions
}

/// Creates a question about small random triangles for each pair of a number of triangles and a
/// maximum leaf size. There are up to seven triangles more. Every other question is far from the
/// origin.
fn soup_questions(
    rng: &mut Rng,
    checks: &[TreeCheck],
    sizes: &[(usize, u32)],
) -> Vec<ExamQuestion> {
    soup_questions_of_size(0.2, rng, checks, sizes)
}

/// Creates the same questions as [`soup_questions`], with triangles of this size.
fn soup_questions_of_size(
    size: f64,
    rng: &mut Rng,
    checks: &[TreeCheck],
    sizes: &[(usize, u32)],
) -> Vec<ExamQuestion> {
    let question = |(index, &(count, max_leaf_size)): (usize, &(usize, u32))| {
        let count = count + rng.index(8);
        let shapes = meshes::soup(rng, count, 3.0, size);
        let elsewhere = Place::elsewhere(rng);
        let shapes = if index % 2 == 1 {
            elsewhere.shapes(&shapes)
        } else {
            shapes
        };
        build_question(checks, shapes, max_leaf_size)
    };
    sizes.iter().enumerate().map(question).collect()
}

pub(super) const PARTITION: Declaration = Declaration {
    id: "build.partition",
    title: "every primitive is in exactly one leaf",
    look: "Return a tree whose root is nodes[root]: from there, l and r, which are indices into \
           nodes, lead to the leaves. A leaf holds start..start + size of the list that you \
           return, and together the leaves hold each primitive once.",
    section: "building.md#a-leaf-is-a-slice-of-the-list",
    tests: &["Every primitive is…"],
    questions: |rng| {
        let many = soup_questions(rng, &[Partition], &[(37, 1), (200, 4)]);
        with_domain(
            many,
            rng,
            &[Partition],
            8,
            &[Scattered, WithoutArea, Scattered],
        )
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const CONTAINS: Declaration = Declaration {
    id: "build.contains",
    title: "every box contains everything below it",
    look: "A node's box encloses the whole boxes of all primitives below it. Those of a leaf are \
           start..start + size in the list that you return: compare a leaf's box with them, and \
           the boxes of the nodes above with those of their children.",
    section: "building.md#the-contract",
    tests: &["The box of a node…"],
    questions: |rng| {
        let many = soup_questions(rng, &[Contains], &[(64, 1), (300, 4)]);
        with_domain(many, rng, &[Contains], 7, &[Scattered, DifferentSizes])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const TIGHT: Declaration = Declaration {
    id: "build.tight",
    title: "no box is larger than its contents need",
    look: "A node's box is the union of its primitives' boxes. A box that starts at the origin \
           instead of BBox::EMPTY, or is the parent's box, is too large.",
    section: "building.md#start-each-box-empty",
    tests: &["The box of a node…"],
    questions: |rng| {
        let many = soup_questions(rng, &[Tight], &[(64, 1), (150, 4)]);
        with_domain(many, rng, &[Tight], 10, &[Scattered, FlatBoxes])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const LEAF_SIZE: Declaration = Declaration {
    id: "build.leaf_size",
    title: "no leaf holds more than max_leaf_size primitives",
    look: "Split a node until it has at most max_leaf_size primitives, even if a leaf would be \
           cheaper by the heuristic.",
    section: "building.md#when-a-node-becomes-a-leaf",
    tests: &["A node is a leaf…"],
    questions: |rng| {
        let crowd = &mut rng.sequence("build.leaf_size.crowd");
        let crowd = build_question(&[LeafSize], meshes::soup(crowd, 100, 0.3, 2.5), 1);
        // The triangles are so large that the heuristic alone would make some leaves too large. In
        // the first question, there are so many triangles that some node is split at its very last
        // plane. In the last question, they are so close together that buckets over the node's box
        // do not separate them.
        let sizes = [(300, 1), (60, 2), (150, 4), (150, 8)];
        let mut questions = soup_questions_of_size(2.5, rng, &[LeafSize], &sizes);
        questions.push(crowd);
        with_domain(questions, rng, &[LeafSize], 7, &[Scattered, DifferentSizes])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const STOPS: Declaration = Declaration {
    id: "build.stops",
    title: "a node with at most max_leaf_size primitives is a leaf",
    look: "A node is a leaf if and only if it has at most max_leaf_size primitives. That holds for \
           every node, the root included, and for every max_leaf_size.",
    section: "building.md#when-a-node-becomes-a-leaf",
    tests: &["A node is a leaf…"],
    questions: |rng| {
        let checks = [Stops, LeafSize];
        let mut questions = soup_questions(rng, &[Stops], &[(64, 2), (160, 8)]);
        // The same primitives are asked again with another maximum leaf size. The root is a node like
        // any other: as many primitives as fit into a leaf, and one more.
        let small = rng.integer(5, 10) as usize;
        for (count, most) in [(small, 130), (rng.integer(300, 999) as usize, 2)] {
            let balls = (0..count).map(|_| meshes::sphere(rng.point(3.0), 0.1));
            let balls: Vec<_> = balls.collect();
            let fits = count as u32;
            for max_leaf_size in [fits, fits - 1, fits + 1].into_iter().take(most) {
                questions.push(build_question(&checks, balls.clone(), max_leaf_size));
            }
        }
        with_domain(questions, rng, &checks, 8, &[Scattered, DifferentSizes])
    },
    ..Declaration::in_group(groups::TREES)
};
