//! Answers the grader's questions element by element, so that a panic affects only its own element.

use protocol::function::Input;
use protocol::{
    Answer, Corners, ElementOutcome, Geometry, LocalDirection, Output, Query, Question, Rows, Table,
};

use crate::harness::attempt::{attempt, attempt_each};
use crate::render::integrator::{RenderSettings, render};
use crate::scene::Scene;
use crate::submission::Submission;

/// Returns a submission's answer to a question.
pub fn answer_question(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::SampleRay(Table { subject, rows }) => call_each(
            rows,
            || submission.camera(subject),
            |camera, sample| camera.ray(sample.pixel, sample.offset),
        ),
        Question::Hit(Table { subject, rows }) => match subject {
            Geometry::List { shapes } => call_each(
                rows,
                || submission.primitive_list(shapes),
                |list, ray| list.closest_hit(ray),
            ),
            Geometry::Tree {
                shapes,
                nodes,
                root,
            } => call_each(
                rows,
                || submission.prebuilt_tree(shapes, nodes, *root as usize),
                |bvh, ray| bvh.closest_hit(ray),
            ),
            Geometry::BuiltTree {
                shapes,
                max_leaf_size,
            } => call_each(
                rows,
                || submission.build(shapes, *max_leaf_size as usize),
                |bvh, ray| bvh.closest_hit(ray),
            ),
        },
        Question::BBoxHit(Table { subject, rows }) => call_each(
            rows,
            || *subject,
            |Corners { min, max }, Query { ray, times }| {
                submission.intersect_box(*min, *max, ray, *times)
            },
        ),
        Question::Reflect(Table { subject: (), rows }) => call_each(
            rows,
            || (),
            |(), LocalDirection { direction }| LocalDirection {
                direction: submission.reflect(*direction),
            },
        ),
        Question::Build {
            shapes,
            max_leaf_size,
        } => {
            let tree = attempt(|| {
                let tree = submission.build(shapes, *max_leaf_size as usize).tree();
                let (primitives, max) = (shapes.len(), Question::max_nodes(shapes.len()));
                assert!(
                    tree.nodes.len() <= max && tree.order.len() <= max,
                    "the tree over {primitives} primitives has {} nodes and {} primitives: too many",
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
                Ok(scene) => attempt(|| render(submission, &scene, &settings)).into(),
                // This is not the submission's fault, so it must not look like a wrong answer or a
                // panic. The grader reports the missing answer.
                Err(error) => {
                    eprintln!("error in the exam's scene: {error}");
                    ElementOutcome::Skipped
                }
            })
        }
    }
}

/// Calls a function once per row, on the subject that `make` creates. The subject is created for the
/// first row, so that a panic in a constructor is reported like any other panic.
fn call_each<S, I: Input, O: Output>(
    rows: &Rows<I>,
    make: impl Fn() -> S,
    call: impl Fn(&S, &I) -> O,
) -> Answer {
    let mut subject = None;
    O::answer(attempt_each(&rows.to_vec(), |row| {
        call(subject.get_or_insert_with(&make), row)
    }))
}
