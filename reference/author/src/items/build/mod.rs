//! Task 3, step 1: building trees. What comes back is a tree, and is judged part by part.

mod cost;
mod split;
mod structure;
mod unusual_inputs;

use grader::exam::TreeCheck::{Partition, Split};
use grader::exam::{ExamQuestion, Item, Key, Task, TreeCheck};
use protocol::{Question, Shape};

use super::meshes;
use crate::seed::Seed;

pub use cost::{MAX_CORRECT_COST, MIN_ADJACENT_COST, relative_cost};

/// The items of the task `build`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 16] = [
        structure::partition,
        structure::contains,
        structure::tight,
        structure::leaf_size,
        structure::stops,
        unusual_inputs::negative,
        unusual_inputs::coincident,
        unusual_inputs::concentric,
        unusual_inputs::coplanar,
        unusual_inputs::collinear,
        unusual_inputs::outlier,
        unusual_inputs::one_or_none,
        split::one_split,
        cost::cost_strands,
        cost::cost_sheets,
        cost::cost_town,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

/// An item with one question more than its idea: without a tree, or with half of all in one leaf,
/// it is wrong. How large leaves may be is the idea of one item. Its primitives lie far apart, so that
/// no heuristic would rather keep them together.
fn item(name: &str, points: u32, text: [&str; 2], mut questions: Vec<ExamQuestion>) -> Item {
    let mut draw = Seed(0).rng("build.control");
    let soup = meshes::soup(&mut draw, 24, 2.0, 0.1);
    questions.push(build_question(&[Partition, Split], soup, 4));
    super::item(Task::Build, name, points, text, questions)
}

fn build_question(judged: &[TreeCheck], shapes: Vec<Shape>, max_leaf_size: u32) -> ExamQuestion {
    let question = Question::Build {
        shapes,
        max_leaf_size,
    };
    let key = Key::Tree {
        checks: judged.to_vec(),
        sweep_cost: None,
    };
    ExamQuestion::new(question, key)
}
