//! Answers to the grader's questions, element by element: a panic costs only its own.

use glam::Vec3;
use protocol::{
    Answer, Interval, Outcome, Panic, PinholeCamera, Question, Ray, Rays, Sample, Samples, Trace,
};

use crate::attempt::{attempt, each};
use crate::integrator::{Sampling, radiance};
use crate::scene::Scene;
use crate::submission::{Hierarchy, Submission};

/// What a submission answers. A panic outside any element, in one of its constructors, is told as
/// the first element's; the others are given up.
pub fn question(submission: &dyn Submission, question: &Question) -> Answer {
    match attempt(|| answer(submission, question)) {
        Outcome::Value(answer) => answer,
        Outcome::Panicked(panic) => panicked(question, panic),
        Outcome::GivenUp => unreachable!("nothing is given up at the first attempt"),
    }
}

fn answer(submission: &dyn Submission, question: &Question) -> Answer {
    match question {
        Question::Camera { camera, samples } => rays(submission, camera, samples),
        Question::Shapes { shapes, rays } => {
            let list = submission.list(shapes);
            hits(rays, |ray| list.closest_hit(ray))
        }
        Question::BBox { min, max, shots } => spans(submission, *min, *max, shots),
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
            let bvh = submission.planted(shapes, nodes, *root as usize);
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
            let sampling = Sampling {
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
        Question::Camera { .. } => Answer::Rays(first(panic, question.count())),
        Question::Shapes { .. } | Question::Traverse { .. } | Question::BuildAndTraverse { .. } => {
            Answer::Hits(first(panic, question.count()))
        }
        Question::BBox { .. } => Answer::Spans(first(panic, question.count())),
        Question::Build { .. } => Answer::Tree(Outcome::Panicked(panic)),
        Question::Radiance { .. } => Answer::Picture(Outcome::Panicked(panic)),
        Question::Done => Answer::Done,
    }
}

fn first<T>(panic: Panic, count: usize) -> Vec<Outcome<T>> {
    let given_up = std::iter::repeat_with(|| Outcome::GivenUp);
    let outcomes = std::iter::once(Outcome::Panicked(panic)).chain(given_up);
    outcomes.take(count).collect()
}

/// A ray for each sample.
fn rays(submission: &dyn Submission, lens: &PinholeCamera, samples: &Samples) -> Answer {
    let camera = submission.camera(lens);
    Answer::Rays(each(&samples.on(lens.film), |sample: &Sample| {
        camera.ray(sample.pixel, sample.offset)
    }))
}

/// A hit, or none, for each ray.
fn hits(rays: &Rays, hit: impl FnMut(&Ray) -> Option<Trace>) -> Answer {
    Answer::Hits(each(&rays.to_vec(), hit))
}

/// The times inside a box, or none, for each shot.
fn spans(submission: &dyn Submission, min: Vec3, max: Vec3, shots: &[(Ray, Interval)]) -> Answer {
    Answer::Spans(each(shots, |(ray, times)| {
        submission.inside(min, max, ray, *times)
    }))
}

/// The tree that is built over so many primitives.
fn tree(primitives: usize, build: impl FnOnce() -> Box<dyn Hierarchy>) -> Answer {
    let most = Question::most_nodes(primitives);
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
fn picture(submission: &dyn Submission, scene: &str, sampling: &Sampling) -> Answer {
    Answer::Picture(match Scene::from_text(scene) {
        Ok(scene) => attempt(|| radiance(submission, &scene, sampling)),
        // Not the submission's fault, and it must not look so: no answer is the grader's to tell.
        Err(error) => {
            eprintln!("the exam's scene: {error}");
            Outcome::GivenUp
        }
    })
}
