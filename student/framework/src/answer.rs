//! Answers to the grader's questions, element by element: a panic costs only its own.
//!
//! Not generic, and called through `dyn`: compiled here once, not again with every submission.

use glam::{UVec2, Vec2};
use protocol::{
    Answer, Interval, Outcome, Panic, PinholeCamera, Question, Ray, Rays, Sample, Samples, Trace,
    Tree,
};

use crate::ask::Ask;
use crate::attempt::{attempt, each};
use crate::integrator::{Sampling, radiance};
use crate::scene::Scene;
use crate::submission::Submission;

/// What a submission answers. A panic outside any element, in one of its constructors, is told as
/// the first element's; the others are given up.
pub fn question(submission: &dyn Submission, question: &Question) -> Answer {
    match attempt(|| submission.answer(question)) {
        Outcome::Value(answer) => answer,
        Outcome::Panicked(panic) => panicked(question, panic),
        Outcome::GivenUp => unreachable!("nothing is given up at the first attempt"),
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
pub fn rays(
    camera: &PinholeCamera,
    samples: &Samples,
    submission: &mut dyn Ask<(UVec2, Vec2), Ray>,
) -> Answer {
    let samples = samples.on(camera.film);
    Answer::Rays(each(&samples, |sample: &Sample| {
        submission.ask((sample.pixel, sample.offset))
    }))
}

/// A hit, or none, for each ray.
pub fn hits(rays: &Rays, submission: &mut dyn for<'a> Ask<&'a Ray, Option<Trace>>) -> Answer {
    Answer::Hits(each(&rays.to_vec(), |ray| submission.ask(ray)))
}

/// The times inside a box, or none, for each shot.
pub fn spans(
    shots: &[(Ray, Interval)],
    submission: &mut dyn for<'a> Ask<(&'a Ray, Interval), Option<Interval>>,
) -> Answer {
    Answer::Spans(each(shots, |(ray, times)| submission.ask((ray, *times))))
}

/// The tree that is built over so many primitives.
pub fn tree(primitives: usize, submission: &mut dyn Ask<(), Tree>) -> Answer {
    let most = Question::most_nodes(primitives);
    Answer::Tree(attempt(|| {
        let tree = submission.ask(());
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
pub fn picture(submission: &dyn Submission, scene: &str, sampling: &Sampling) -> Answer {
    Answer::Picture(match Scene::from_text(scene) {
        Ok(scene) => attempt(|| radiance(submission, &scene, sampling)),
        // Not the submission's fault, and it must not look so: no answer is the grader's to tell.
        Err(error) => {
            eprintln!("the exam's scene: {error}");
            Outcome::GivenUp
        }
    })
}
