//! Answers the grader's questions element by element, so that a panic affects only its own element.

use glam::Vec3;
use protocol::{
    Answer, ElementOutcome, Interval, Panic, PinholeCamera, Question, Ray, Rays, Sample, Samples,
    Trace,
};

use crate::harness::attempt::{attempt, attempt_each};
use crate::render::integrator::{RenderSettings, render};
use crate::scene::Scene;
use crate::submission::{Hierarchy, Submission};

/// Returns a submission's answer to a question. A panic outside any element, such as in a
/// constructor, is reported for the first element, and the others are skipped.
pub fn answer_question(submission: &dyn Submission, question: &Question) -> Answer {
    match attempt(|| answer(submission, question)) {
        ElementOutcome::Value(answer) => answer,
        ElementOutcome::Panicked(panic) => panicked(question, panic),
        ElementOutcome::Skipped => unreachable!("`attempt` never skips"),
    }
}

fn answer(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::Camera { camera, samples } => rays(submission, camera, samples),
        Question::Shapes { shapes, rays } => {
            let list = submission.primitive_list(shapes);
            hits(rays, |ray| list.closest_hit(ray))
        }
        Question::BBox { min, max, queries } => spans(submission, *min, *max, queries),
        Question::Build {
            shapes,
            max_leaf_size,
        } => tree(shapes.len(), || {
            submission.build(shapes, *max_leaf_size as usize)
        }),
        Question::Traverse {
            shapes,
            nodes,
            root,
            rays,
        } => {
            let bvh = submission.prebuilt_tree(shapes, nodes, *root as usize);
            hits(rays, |ray| bvh.closest_hit(ray))
        }
        Question::BuildAndTraverse {
            shapes,
            max_leaf_size,
            rays,
        } => {
            // Builds the tree when the first ray is answered, so that a panic in `build` is
            // reported like any other panic.
            let build = || submission.build(shapes, *max_leaf_size as usize);
            let mut bvh = None;
            hits(rays, |ray| bvh.get_or_insert_with(build).closest_hit(ray))
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
            picture(submission, scene, &settings)
        }
        Question::Done => Answer::Done,
    }
}

/// Returns an answer that reports the panic for the first element of the question and skips the
/// others.
fn panicked(question: &Question, panic: Panic) -> Answer {
    match question {
        Question::Camera { .. } => Answer::Rays(first_panicked(panic, question.count())),
        Question::Shapes { .. } | Question::Traverse { .. } | Question::BuildAndTraverse { .. } => {
            Answer::Hits(first_panicked(panic, question.count()))
        }
        Question::BBox { .. } => Answer::Spans(first_panicked(panic, question.count())),
        Question::Build { .. } => Answer::Tree(ElementOutcome::Panicked(panic)),
        Question::Radiance { .. } => Answer::Picture(ElementOutcome::Panicked(panic)),
        Question::Done => Answer::Done,
    }
}

/// Returns `count` outcomes: the first is the panic, and all others are skipped.
fn first_panicked<T>(panic: Panic, count: usize) -> Vec<ElementOutcome<T>> {
    let skipped = std::iter::repeat_with(|| ElementOutcome::Skipped);
    let outcomes = std::iter::once(ElementOutcome::Panicked(panic)).chain(skipped);
    outcomes.take(count).collect()
}

/// Generates a ray for each sample.
fn rays(submission: &dyn Submission, pinhole: &PinholeCamera, samples: &Samples) -> Answer {
    let camera = submission.camera(pinhole);
    Answer::Rays(attempt_each(
        &samples.to_vec(pinhole.film),
        |sample: &Sample| camera.ray(sample.pixel, sample.offset),
    ))
}

/// Finds the closest hit of each ray.
fn hits(rays: &Rays, hit: impl FnMut(&Ray) -> Option<Trace>) -> Answer {
    Answer::Hits(attempt_each(&rays.to_vec(), hit))
}

/// Finds, for each query, the part of its `times` interval in which the ray is inside the box.
fn spans(submission: &dyn Submission, min: Vec3, max: Vec3, queries: &[(Ray, Interval)]) -> Answer {
    Answer::Spans(attempt_each(queries, |(ray, times)| {
        submission.intersect_box(min, max, ray, *times)
    }))
}

/// Builds a tree over this many primitives, and checks that it does not have too many nodes.
fn tree(primitives: usize, build: impl FnOnce() -> Box<dyn Hierarchy>) -> Answer {
    let max = Question::max_nodes(primitives);
    Answer::Tree(attempt(|| {
        let tree = build().tree();
        assert!(
            tree.nodes.len() <= max && tree.order.len() <= max,
            "the tree over {primitives} primitives has {} nodes and {} primitives: too many",
            tree.nodes.len(),
            tree.order.len(),
        );
        tree
    }))
}

/// Renders a path-traced picture. `scene` is the text of a scene file.
fn picture(submission: &dyn Submission, scene: &str, settings: &RenderSettings) -> Answer {
    Answer::Picture(match Scene::from_text(scene) {
        Ok(scene) => attempt(|| render(submission, &scene, settings)),
        // This is not the submission's fault, so it must not look like a wrong answer or a panic.
        // The grader reports the missing answer.
        Err(error) => {
            eprintln!("error in the exam's scene: {error}");
            ElementOutcome::Skipped
        }
    })
}
