//! Answers the grader's questions element by element, so that a panic only affects its own element.

use protocol::{Answer, ElementOutcome, Question};

use crate::harness::attempt::{AttemptsAtTable, attempt};
use crate::render::clay::Clay;
use crate::render::renderer::render;
use crate::scene::Scene;
use crate::submission::{Submission, World};

/// Returns a submission's answer to a question.
pub fn answer_question(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::Build {
            shapes,
            max_leaf_size,
        } => {
            let tree = attempt(|| {
                let tree = submission.build(shapes, *max_leaf_size as usize).tree();
                let (primitives, max) = (shapes.len(), Question::max_nodes(shapes.len()));
                assert!(
                    tree.nodes.len() <= max && tree.order.len() <= max,
                    "the tree is too large: it was built from {primitives} primitives, but has {} \
                     nodes and stores {} primitives",
                    tree.nodes.len(),
                    tree.order.len(),
                );
                tree
            });
            Answer::Tree(tree.into())
        }
        Question::Radiance {
            scene,
            film,
            samples,
            seed,
        } => Answer::Picture(match Scene::from_text(scene) {
            Ok(scene) => attempt(|| {
                let scene = scene.on_film(*film);
                let world = World::new(submission, &scene);
                render(&Clay::new(&scene, &world, *seed), *film, *samples)
            })
            .into(),
            // This isn't the submission's fault, so it must not look like a wrong answer or a
            // panic. The grader reports the missing answer.
            Err(error) => {
                eprintln!("error in the exam's scene: {error}");
                ElementOutcome::Skipped
            }
        }),
        other => {
            let table = other.table().expect("every other question is a table");
            table.answer(submission, &mut AttemptsAtTable::default())
        }
    }
}
