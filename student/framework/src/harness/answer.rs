//! Answers the grader's questions element by element, so that a panic affects only its own element.

use protocol::{Answer, ElementOutcome, Question};

use crate::harness::attempt::{attempt, attempt_each};
use crate::render::integrator::{RenderSettings, render};
use crate::scene::Scene;
use crate::submission::Submission;

/// Returns a submission's answer to a question.
pub fn answer_question(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::Camera { camera, samples } => Answer::Rays(attempt_with(
            || submission.camera(camera),
            &samples.to_vec(camera.film),
            |camera, sample| camera.ray(sample.pixel, sample.offset),
        )),
        Question::Shapes { shapes, rays } => Answer::Hits(attempt_with(
            || submission.primitive_list(shapes),
            &rays.to_vec(),
            |list, ray| list.closest_hit(ray),
        )),
        Question::BBox { min, max, queries } => {
            Answer::Spans(attempt_each(queries, |(ray, times)| {
                submission.intersect_box(*min, *max, ray, *times)
            }))
        }
        Question::Build {
            shapes,
            max_leaf_size,
        } => Answer::Tree(attempt(|| {
            let tree = submission.build(shapes, *max_leaf_size as usize).tree();
            let (primitives, max) = (shapes.len(), Question::max_nodes(shapes.len()));
            assert!(
                tree.nodes.len() <= max && tree.order.len() <= max,
                "the tree over {primitives} primitives has {} nodes and {} primitives: too many",
                tree.nodes.len(),
                tree.order.len(),
            );
            tree
        })),
        Question::Traverse {
            shapes,
            nodes,
            root,
            rays,
        } => Answer::Hits(attempt_with(
            || submission.prebuilt_tree(shapes, nodes, *root as usize),
            &rays.to_vec(),
            |bvh, ray| bvh.closest_hit(ray),
        )),
        Question::BuildAndTraverse {
            shapes,
            max_leaf_size,
            rays,
        } => Answer::Hits(attempt_with(
            || submission.build(shapes, *max_leaf_size as usize),
            &rays.to_vec(),
            |bvh, ray| bvh.closest_hit(ray),
        )),
        Question::Radiance {
            scene,
            film,
            samples,
            bounces,
            seed,
        } => {
            let settings = RenderSettings {
                film: *film,
                samples: *samples,
                bounces: *bounces,
                seed: *seed,
            };
            Answer::Picture(match Scene::from_text(scene) {
                Ok(scene) => attempt(|| render(submission, &scene, &settings)),
                // This is not the submission's fault, so it must not look like a wrong answer or a
                // panic. The grader reports the missing answer.
                Err(error) => {
                    eprintln!("error in the exam's scene: {error}");
                    ElementOutcome::Skipped
                }
            })
        }
        Question::Done => Answer::Done,
    }
}

/// Runs `answer` for each element with the subject that `make` creates. The subject is created for
/// the first element, so that a panic in a constructor is reported like any other panic.
fn attempt_with<S, Q, T>(
    make: impl Fn() -> S,
    elements: &[Q],
    answer: impl Fn(&S, &Q) -> T,
) -> Vec<ElementOutcome<T>> {
    let mut subject = None;
    attempt_each(elements, |element| {
        answer(subject.get_or_insert_with(&make), element)
    })
}
