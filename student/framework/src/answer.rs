//! Answers to the grader's questions, element by element: a panic costs only its own.

use glam::Vec3;
use protocol::{
    Answer, ElementOutcome, Interval, Panic, PinholeCamera, Question, Ray, Rays, Sample, Samples,
    Trace,
};

use crate::attempt::{attempt, attempt_each};
use crate::integrator::{RenderSettings, render};
use crate::scene::Scene;
use crate::submission::{Hierarchy, Submission};

/// What a submission answers. A panic outside any element, in one of its constructors, is told as
/// the first element's; the others are given up.
pub fn answer_question(submission: &dyn Submission, question: &Question) -> Answer {
    match attempt(|| answer(submission, question)) {
        ElementOutcome::Value(answer) => answer,
        ElementOutcome::Panicked(panic) => panicked(question, panic),
        ElementOutcome::Skipped => unreachable!("nothing is given up at the first attempt"),
    }
}

fn answer(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::Camera { camera, samples } => rays(submission, camera, samples),
        Question::Shapes { shapes, rays } => {
            let list = submission.primitive_list(shapes);
            hits(rays, |ray| list.closest_hit(ray))
        }
        Question::BBox {
            min,
            max,
            queries: shots,
        } => spans(submission, *min, *max, shots),
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
            // Built at the first ray, so that a panic in `build` is told like any other.
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
            let sampling = RenderSettings {
                film: *film,
                samples: *samples,
                bounces: *bounces,
                seed: *seed,
            };
            picture(submission, scene, &sampling)
        }
        Question::Done => Answer::Done,
    }
}

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

fn first_panicked<T>(panic: Panic, count: usize) -> Vec<ElementOutcome<T>> {
    let given_up = std::iter::repeat_with(|| ElementOutcome::Skipped);
    let outcomes = std::iter::once(ElementOutcome::Panicked(panic)).chain(given_up);
    outcomes.take(count).collect()
}

/// A ray for each sample.
fn rays(submission: &dyn Submission, lens: &PinholeCamera, samples: &Samples) -> Answer {
    let camera = submission.camera(lens);
    Answer::Rays(attempt_each(
        &samples.to_vec(lens.film),
        |sample: &Sample| camera.ray(sample.pixel, sample.offset),
    ))
}

/// A hit, or none, for each ray.
fn hits(rays: &Rays, hit: impl FnMut(&Ray) -> Option<Trace>) -> Answer {
    Answer::Hits(attempt_each(&rays.to_vec(), hit))
}

/// The times inside a box, or none, for each shot.
fn spans(submission: &dyn Submission, min: Vec3, max: Vec3, shots: &[(Ray, Interval)]) -> Answer {
    Answer::Spans(attempt_each(shots, |(ray, times)| {
        submission.intersect_box(min, max, ray, *times)
    }))
}

/// The tree that is built over so many primitives.
fn tree(primitives: usize, build: impl FnOnce() -> Box<dyn Hierarchy>) -> Answer {
    let most = Question::max_nodes(primitives);
    Answer::Tree(attempt(|| {
        let tree = build().tree();
        assert!(
            tree.nodes.len() <= most && tree.order.len() <= most,
            "{primitives} primitives became {} nodes over {} primitives",
            tree.nodes.len(),
            tree.order.len(),
        );
        tree
    }))
}

/// The path-traced picture of the scene that this text describes.
fn picture(submission: &dyn Submission, scene: &str, sampling: &RenderSettings) -> Answer {
    Answer::Picture(match Scene::from_text(scene) {
        Ok(scene) => attempt(|| render(submission, &scene, sampling)),
        // Not the submission's fault, and it must not look so: no answer is the grader's to tell.
        Err(error) => {
            eprintln!("the exam's scene: {error}");
            ElementOutcome::Skipped
        }
    })
}
