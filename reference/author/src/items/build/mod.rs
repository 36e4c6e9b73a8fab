//! Task 3, step 1: building trees. What comes back is a tree, and is judged part by part.

mod cost;
mod split;
mod structure;
mod unusual;

use grader::exam::TreePart::{Partition, Split};
use grader::exam::{Asked, Item, Key, Task, TreePart};
use protocol::{Question, Shape};

use super::meshes;
use crate::seed::Seed;

pub use cost::{CONFUSED, HONEST, by_the_sweep};

/// The items of the task `build`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 16] = [
        structure::partition,
        structure::contains,
        structure::tight,
        structure::leaf_size,
        structure::stops,
        unusual::negative,
        unusual::coincident,
        unusual::concentric,
        unusual::coplanar,
        unusual::collinear,
        unusual::outlier,
        unusual::one_or_none,
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
fn item(name: &str, points: u32, text: [&str; 2], mut questions: Vec<Asked>) -> Item {
    let mut draw = Seed(0).draw("build.control");
    let soup = meshes::soup(&mut draw, 24, 2.0, 0.1);
    questions.push(asked(&[Partition, Split], soup, 4));
    super::item(Task::Build, name, points, text, questions)
}

fn asked(judged: &[TreePart], shapes: Vec<Shape>, max_leaf_size: u32) -> Asked {
    let question = Question::Build {
        shapes,
        max_leaf_size,
    };
    let key = Key::Tree {
        judged: judged.to_vec(),
        sweep_cost: None,
    };
    Asked::new(question, key)
}
