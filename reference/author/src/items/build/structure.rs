//! What must hold of every tree.

use grader::exam::TreeCheck::{self, Contains, LeafSize, Partition, Stops, Tight};
use grader::exam::{ExamQuestion, Item};

use super::{build_question, item};
use crate::items::meshes;
use crate::seed::Seed;

/// Soups of several sizes, for leaves of several sizes.
fn soup_questions(
    name: &str,
    seed: Seed,
    judged: &[TreeCheck],
    sizes: &[(usize, u32)],
) -> Vec<ExamQuestion> {
    soup_questions_of_size(0.2, name, seed, judged, sizes)
}

/// The same of primitives of this size.
fn soup_questions_of_size(
    size: f64,
    name: &str,
    seed: Seed,
    judged: &[TreeCheck],
    sizes: &[(usize, u32)],
) -> Vec<ExamQuestion> {
    let mut draw = seed.rng(name);
    let question = |&(count, max_leaf_size): &(usize, u32)| {
        let shapes = meshes::soup(&mut draw, count, 3.0, size);
        build_question(judged, shapes, max_leaf_size)
    };
    sizes.iter().map(question).collect()
}

pub(super) fn partition(seed: Seed) -> Item {
    item(
        "partition",
        2,
        [
            "every primitive is in exactly one leaf",
            "A partition loses nothing and doubles nothing: the primitives of a node go to one of \
             its children each, and start and size of the leaves count all of them once.",
        ],
        soup_questions(
            "build.partition",
            seed,
            &[Partition],
            &[(37, 1), (90, 2), (200, 4), (120, 8)],
        ),
    )
}

pub(super) fn contains(seed: Seed) -> Item {
    item(
        "contains",
        2,
        [
            "every box holds all that is below it",
            "If a box misses some of its primitives, the bucket in which a primitive was counted may \
             not be the side to which it was moved.",
        ],
        soup_questions("build.contains", seed, &[Contains], &[(64, 1), (300, 4)]),
    )
}

pub(super) fn tight(seed: Seed) -> Item {
    item(
        "tight",
        1,
        [
            "no box is larger than what is below it needs",
            "A node's box is the union of its primitives' boxes. One that starts at the origin \
             instead of BBox::EMPTY, or is its parent's, is too large.",
        ],
        soup_questions("build.tight", seed, &[Tight], &[(64, 1), (150, 4)]),
    )
}

pub(super) fn leaf_size(seed: Seed) -> Item {
    let mut draw = seed.rng("build.leaf_size.crowd");
    let crowd = build_question(&[LeafSize], meshes::soup(&mut draw, 100, 0.3, 2.5), 1);
    item(
        "leaf_size",
        2,
        [
            "no leaf holds more than max_leaf_size primitives",
            "Split until a node has at most so many, whatever the heuristic says of it.",
        ],
        // So large that the heuristic alone would rather not split some of them; in the first one so
        // many that some node is split at its very last plane; and in the last one so close to each
        // other that buckets over the node's box do not tell them apart.
        soup_questions_of_size(
            2.5,
            "build.leaf_size",
            seed,
            &[LeafSize],
            &[(300, 1), (60, 2), (150, 4), (150, 8)],
        )
        .into_iter()
        .chain([crowd])
        .collect(),
    )
}

pub(super) fn stops(seed: Seed) -> Item {
    item(
        "stops",
        1,
        [
            "a node with at most max_leaf_size primitives is a leaf",
            "max_leaf_size itself is small enough: compare with <=.",
        ],
        soup_questions(
            "build.stops",
            seed,
            &[Stops],
            &[(64, 2), (150, 4), (160, 8)],
        ),
    )
}
