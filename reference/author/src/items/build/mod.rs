//! Items of task 3, step 1: building trees. The answer is a tree, and each of its properties is
//! judged separately.

mod cost;
mod draw;
mod split;
mod structure;
mod unusual_inputs;

use judging::exam::TreeCheck::{Partition, Split};
use judging::exam::{ExamQuestion, TreeCheck};
use protocol::{Question, Shape};

use super::meshes;
use crate::domains::build::BUILD;
use crate::items::AuthoredTask;
use crate::seed::Seed;

pub use cost::relative_cost;

/// The task `build`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        structure::PARTITION,
        structure::CONTAINS,
        structure::TIGHT,
        structure::LEAF_SIZE,
        structure::STOPS,
        unusual_inputs::NEGATIVE,
        unusual_inputs::COPLANAR,
        unusual_inputs::COLLINEAR,
        unusual_inputs::ONE_OR_NONE,
        // A row of a few primitives comes before the lists where the same mistakes also cost points,
        // because it can be worked out by hand.
        split::ONE_SPLIT,
        unusual_inputs::OUTLIER,
        cost::COST_STRANDS,
        cost::COST_SHEETS,
        cost::COST_TOWN,
        // These items come last, because a task is stopped after two crashes. Builders that recurse
        // infinitely on these items' questions are often correct otherwise.
        unusual_inputs::COINCIDENT,
        unusual_inputs::CONCENTRIC,
    ],
    domains: &[&BUILD],
    untested: &[(
        "You may reorder the primitives and the nodes.",
        "This is a permission: every item accepts any order.",
    )],
    finish: |seed, items| {
        let control = control(seed);
        for item in items {
            // Put large questions last, so that the first wrong answer is about a tree that is
            // small enough for people to follow.
            item.questions().sort_by_key(is_large);
            item.questions().push(control.clone());
        }
    },
};

/// Returns whether a question is about more than 500 primitives.
fn is_large(question: &ExamQuestion) -> bool {
    matches!(&question.question, Question::Build { shapes, .. } if shapes.len() > 500)
}

/// Returns the question that comes last in every item. An answer is wrong if the tree is missing or
/// has half of the primitives in one leaf. The primitives are far apart, so that no heuristic
/// prefers to keep them together. The maximum leaf size is tested by a different item.
fn control(seed: Seed) -> ExamQuestion {
    let soup = meshes::soup(&mut seed.rng("build.control"), 24, 2.0, 0.1);
    build_question(&[Partition, Split], soup, 4)
}

/// Creates a question about a tree over these shapes, after renumbering them.
fn build_question(
    checks: &[TreeCheck],
    shapes: impl IntoIterator<Item = Shape>,
    max_leaf_size: u32,
) -> ExamQuestion {
    ExamQuestion::tree(meshes::number_shapes(shapes), max_leaf_size, checks, None)
}
