//! Items of task 3, step 1: building trees. The answer is a tree, and each of its properties is
//! judged separately.

mod cost;
mod split;
mod structure;
mod unusual_inputs;

use judging::exam::TreeCheck::{Partition, Split};
use judging::exam::{ExamQuestion, Key, TreeCheck};
use protocol::{Question, Shape};

use super::meshes;
use crate::items::{Declaration, DeclaredItem, draw_items};
use crate::seed::Seed;

pub use cost::relative_cost;

/// Returns the items of the task `build`.
pub fn items(seed: Seed) -> Vec<DeclaredItem> {
    let all: [fn(Seed) -> DeclaredItem; 16] = [
        structure::partition,
        structure::contains,
        structure::tight,
        structure::leaf_size,
        structure::stops,
        unusual_inputs::negative,
        unusual_inputs::coplanar,
        unusual_inputs::collinear,
        unusual_inputs::outlier,
        unusual_inputs::one_or_none,
        split::one_split,
        cost::cost_strands,
        cost::cost_sheets,
        cost::cost_town,
        // Last, because builders that recurse without end on these are often right otherwise, and a
        // task is stopped after two crashes.
        unusual_inputs::coincident,
        unusual_inputs::concentric,
    ];
    draw_items(seed, &all)
}

/// Creates an item, and adds a control question, whose answer is wrong if there is no tree or if
/// half of the primitives are in one leaf. The control's primitives are far apart, so that no
/// heuristic prefers to keep them together: the maximum leaf size is tested by another item.
fn item(seed: Seed, declaration: Declaration, mut questions: Vec<ExamQuestion>) -> DeclaredItem {
    let mut rng = seed.rng("build.control");
    let soup = meshes::soup(&mut rng, 24, 2.0, 0.1);
    questions.push(build_question(&[Partition, Split], soup, 4));
    super::item(declaration, questions)
}

fn build_question(checks: &[TreeCheck], shapes: Vec<Shape>, max_leaf_size: u32) -> ExamQuestion {
    let question = Question::Build {
        shapes,
        max_leaf_size,
    };
    let key = Key::Tree {
        checks: checks.to_vec(),
        sweep_cost: None,
    };
    ExamQuestion::new(question, key)
}
