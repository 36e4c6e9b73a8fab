//! Items about primitives in unusual arrangements.

use glam::{DVec3, dvec3};
use judging::exam::ExamQuestion;
use judging::exam::TreeCheck::{self, Contains, LeafSize, Partition, Split, Stops, Tight};
use judging::symptom::Symptom;

use super::build_question;
use super::draw::Arrangement::{Concentric, Equal, EqualPair, Outlier, Plane, Row, Scattered};
use super::draw::{self, Arrangement};
use crate::items::{Declaration, groups, meshes};
use crate::oracle::scan;
use crate::seed::Rng;

/// All properties of a tree except its cost.
const ALL: &[TreeCheck] = &[Partition, Contains, Tight, LeafSize, Stops];

/// The symptoms of a builder that doesn't split primitives along an axis without extent.
const NOT_SPLIT: &[Symptom] = &[
    Symptom::of("nodes"),
    Symptom::of("leaves"),
    Symptom::of("splits"),
];

/// The symptoms of a builder that doesn't split primitives with a common centre.
const NOT_SPLIT_BY_COUNT: &[Symptom] = &[
    Symptom::of("nodes"),
    Symptom::of("leaves"),
    Symptom::of("splits"),
    Symptom::of("leaf size"),
];

/// Returns the given questions, followed by random questions from the domain about primitives in
/// the given arrangements. The additional questions check how the primitives are split, using
/// [`Split`] if a different item tests the exact size of leaves.
fn with_domain(
    mut questions: Vec<ExamQuestion>,
    rng: &mut Rng,
    split: TreeCheck,
    count: usize,
    arrangements: &[Arrangement],
) -> Vec<ExamQuestion> {
    // Only the last two items ask about primitives with a common centre.
    let checks: &[TreeCheck] = if split == Split {
        &[Partition, Split, Contains]
    } else {
        ALL
    };
    let drawn = draw::questions(rng, checks, count, (arrangements, 66), |call| {
        let (all, most) = (call.shapes.len(), call.max_leaf_size as usize);
        all > 1 && (split != Split || 2 * most < all)
    });
    questions.extend(drawn);
    questions
}

pub(super) const NEGATIVE: Declaration = Declaration {
    id: "build.negative",
    title: "negative coordinates work too",
    look: "A box that grows from (0, 0, 0) always contains that point, and a cast to usize turns \
        negative numbers into 0.",
    look_fits: &[
        Symptom::of("box too large"),
        Symptom::of("leaves"),
        Symptom::of("splits"),
    ],
    section: "building.md#start-each-box-empty",
    tests: &["Every primitive is…", "The box of a node…"],
    questions: |rng| {
        let far = dvec3(-20.0, -30.0, -10.0);
        let triangles = (0..80).map(|_| {
            let center = far + rng.point(4.0);
            meshes::random_flat_triangle(rng, center, 0.5)
        });
        let checks = [Partition, Contains, Tight];
        let mut questions = vec![build_question(&checks, triangles, 2)];
        let drawn = draw::questions(rng, &checks, 5, (&[Scattered], 40), |call| {
            let mut shapes = call.shapes.iter().map(scan::bounds);
            shapes.len() > 1 && shapes.any(|bounds| bounds.min.min_element() < 0.0)
        });
        questions.extend(drawn);
        questions
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const COINCIDENT: Declaration = Declaration {
    id: "build.coincident",
    title: "primitives with the same centre are split by count",
    look: "If all centres coincide, no plane separates the primitives. A leaf with all of them is too \
        large, and a split where one side is empty doesn't help: split them by count.",
    look_fits: NOT_SPLIT_BY_COUNT,
    section: "building.md#when-all-centres-coincide",
    tests: &["If all centres coincide,…"],
    questions: |rng| {
        let center = rng.point(2.0);
        let same = meshes::random_flat_triangle(rng, center, 0.5);
        let all = vec![same; 20];
        // More than half of the primitives coincide, so a leaf that holds all the coincident
        // primitives is considered unsplit.
        let mut some = meshes::soup(rng, 17, 3.0, 0.4);
        some.extend(vec![same; 30]);
        let ball = meshes::sphere((8.0 * center).round() / 8.0, 0.5);
        let many = vec![ball; rng.integer(130, 300) as usize];
        let mut questions = vec![
            build_question(&[Partition, Split], all.clone(), 1),
            build_question(&[Partition, Split], all, 4),
            build_question(&[Partition, Split], rng.shuffled(some), 2),
            build_question(ALL, many, 1),
        ];
        // These are pairs of different triangles with the same box.
        questions.extend([1, 12].map(|count| {
            let mut shapes = meshes::rectangles(rng, count);
            shapes.push(meshes::sphere(rng.point(4.0), 0.3));
            build_question(ALL, rng.shuffled(shapes), 1)
        }));
        with_domain(questions, rng, LeafSize, 6, &[Equal, EqualPair])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const CONCENTRIC: Declaration = Declaration {
    id: "build.concentric",
    title: "spheres around one centre are split by count",
    look: "The boxes of the spheres differ, but their centres coincide, so no plane between \
        buckets of centres separates them on any axis. Split them by count.",
    look_fits: NOT_SPLIT_BY_COUNT,
    section: "building.md#when-all-centres-coincide",
    tests: &["If all centres coincide,…"],
    questions: |rng| {
        let center = rng.point(2.0);
        let step = rng.uniform(0.2, 0.3) as f32;
        let shells = (1..=13).map(|i| meshes::sphere(center, (step * i as f32).into()));
        // All of these numbers are exact in single precision, so the spheres' centres coincide
        // exactly.
        let exact = (8.0 * center).round() / 8.0;
        let many = (3..rng.integer(140, 300)).map(|i| meshes::sphere(exact, f64::from(i) / 128.0));
        let questions = vec![
            build_question(&[Partition, Split, Contains], shells, 2),
            build_question(ALL, many, 1),
        ];
        with_domain(questions, rng, LeafSize, 5, &[Concentric])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const COPLANAR: Declaration = Declaration {
    id: "build.coplanar",
    title: "a flat grid works too",
    look: "Along one axis, all centres coincide: no plane separates them there, and dividing by \
           their extent gives NaN. Both the search for the cheapest partition and the partition \
           itself must use another axis.",
    look_fits: NOT_SPLIT,
    section: "building.md#an-axis-without-extent",
    tests: &["Every primitive is…", "The box of a node…"],
    questions: |rng| {
        let question = |axis: usize| {
            let start = rng.point(4.0);
            let size = rng.uniform(0.7, 1.3);
            let [x, y] = [1, 2].map(|next| size * DVec3::AXES[(axis + next) % 3]);
            let cells = (0..64).map(|cell| {
                let corner = start + f64::from(cell % 8) * x + f64::from(cell / 8) * y;
                meshes::flat_triangle([corner, corner + x, corner + y], 0)
            });
            build_question(&[Partition, Split, Contains], cells, 2)
        };
        let questions = [0, 1, 2].map(question).to_vec();
        with_domain(questions, rng, Split, 4, &[Plane])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const COLLINEAR: Declaration = Declaration {
    id: "build.collinear",
    title: "a row of primitives along any axis works too",
    look: "Along two axes, all centres coincide. Find the third axis, whether it is x, y or z.",
    look_fits: NOT_SPLIT,
    section: "building.md#an-axis-without-extent",
    tests: &["Every primitive is…", "The box of a node…"],
    questions: |rng| {
        let question = |axis: usize| {
            let start = rng.point(4.0);
            let step = rng.uniform(0.6, 0.9);
            let radius = rng.uniform(0.2, 0.3);
            let center = |i: i32| start + step * f64::from(i) * DVec3::AXES[axis];
            let row = (0..40).map(|i| meshes::sphere(center(i), radius));
            build_question(&[Partition, Split, Contains], row, 3)
        };
        let questions = [0, 1, 2].map(question).to_vec();
        with_domain(questions, rng, Split, 4, &[Row])
    },
    ..Declaration::in_group(groups::TREES)
};

pub(super) const OUTLIER: Declaration = Declaration {
    id: "build.outlier",
    title: "one primitive far from the others does not ruin the tree",
    look: "If one primitive is far away, most of the others end up in one bucket. The split still \
           helps, because it puts them into a smaller node with its own buckets.",
    look_fits: &[Symptom::less("splits"), Symptom::of("leaf size")],
    section: "building.md#one-primitive-far-from-the-others",
    tests: &["Every primitive is…", "The box of a node…"],
    questions: outlier,
    ..Declaration::in_group(groups::TREES)
};

fn outlier(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut crowd = |far: f64| {
        let mut shapes = meshes::soup(rng, 40, 1.0, 0.1);
        let center = far * rng.direction();
        shapes.push(meshes::random_flat_triangle(rng, center, 0.5));
        rng.shuffled(shapes)
    };
    let checks = [Partition, Split, Contains];
    let question = |far: f64| build_question(&checks, crowd(far), 2);
    let mut questions = [100.0, 1000.0].map(question).to_vec();
    // Each triangle is a quarter larger than the previous one, so the last one is over 1000 times
    // as large as the first.
    let growing = (0..32).map(|i| {
        let size = 1e-3 * 1.25f64.powi(i);
        meshes::random_flat_triangle(rng, 4.0 * size * DVec3::ONE, size)
    });
    questions.push(build_question(&checks, growing, 1));
    // There are so many primitives that a builder could switch to a faster, less careful method.
    let count = rng.integer(3000, 4000) as usize;
    let mut many = meshes::many_spheres(rng, count);
    many.push(meshes::sphere((100.0 * rng.direction()).round(), 1.0));
    questions.push(build_question(ALL, rng.shuffled(many), 1));
    with_domain(questions, rng, Split, 5, &[Outlier])
}

pub(super) const ONE_OR_NONE: Declaration = Declaration {
    id: "build.one_or_none",
    title: "trees of zero, one and two primitives are built correctly",
    look: "Without primitives, build no nodes or one leaf of size 0. For one primitive, build one \
        leaf.",
    look_fits: &[
        Symptom::of("nodes"),
        Symptom::of("root"),
        Symptom::of("l"),
        Symptom::of("r"),
        Symptom::of("leaves"),
    ],
    section: "building.md#very-small-inputs",
    tests: &["Without primitives, the…"],
    questions: |rng| {
        let checks = [Partition, Contains];
        let one = meshes::soup(rng, 1, 2.0, 0.5);
        let two = meshes::soup(rng, 2, 2.0, 0.5);
        let mut questions = vec![
            build_question(&checks, Vec::new(), 4),
            build_question(&checks, Vec::new(), 1),
            build_question(&checks, Vec::new(), 1000),
            build_question(&checks, one, 1),
            build_question(&checks, two.clone(), 1),
            build_question(&checks, two, 4),
        ];
        let drawn = draw::questions(rng, &checks, 4, (&[Scattered], 2), |call| {
            !call.shapes.is_empty()
        });
        questions.extend(drawn);
        questions
    },
    ..Declaration::in_group(groups::TREES)
};
