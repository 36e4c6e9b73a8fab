//! The exam's items: one module per task, and one idea per item.
//!
//! An item's keys test only the quantities that its idea is about. Every item has questions with
//! opposite answers (such as hits and misses), so that no constant answer passes it. All questions
//! are generated from the exam's seed, and final exams don't share any questions with the practice
//! exam.

pub mod bbox;
pub mod build;
pub mod camera;
mod complete;
mod declaration;
mod distinct;
mod groups;
pub mod light;
pub mod meshes;
mod paper;
pub mod picture;
pub mod sphere;
mod transform;
pub mod traverse;
pub mod triangle;

use glam::DVec3;
use judging::exam::{ExamQuestion, ExpectedRows, Item, Key};
use protocol::{Geometry, Question, Ray, Shape};
use rayon::prelude::*;

use crate::oracle::{Intersection, Ray64, scan};
use crate::seed::Seed;

pub use declaration::{AuthoredTask, Declaration, DeclaredItem, Group, resolve};
pub use distinct::shares_a_question;

/// The tasks of `rays`, in lecture order.
pub static TASKS: &[&AuthoredTask] = &[
    &camera::TASK,
    &triangle::TASK,
    &sphere::TASK,
    &bbox::TASK,
    &build::TASK,
    &traverse::TASK,
];

/// Returns the items of an exam. Each item comes after the items that it needs. None of the
/// questions is also in the items of the practice exam.
pub fn items(tasks: &[&AuthoredTask], seed: Seed, practice: &[Item]) -> Vec<Item> {
    let tasks = tasks.par_iter().map(|task| task.draw(seed, practice));
    let tasks: Vec<Vec<DeclaredItem>> = tasks.collect();
    resolve(tasks.into_iter().flatten().collect())
}

/// Returns an exam with the items about boxes, for tests.
#[cfg(test)]
pub(crate) fn exam_of_boxes() -> judging::exam::Exam {
    static EXAM: std::sync::LazyLock<judging::exam::Exam> = std::sync::LazyLock::new(|| {
        let items = resolve(bbox::TASK.draw(Seed(1), &[]));
        judging::exam::Exam::new(&judging::assignment::RAYS, "test", items)
    });
    EXAM.clone()
}

/// Returns the ray from one point toward another, in single precision.
pub fn ray(from: DVec3, toward: DVec3) -> Ray {
    Ray::new(from.as_vec3(), (toward - from).as_vec3())
}

/// Creates a question that asks where each ray hits a shape. The question doesn't contain a tree.
fn shape_question(
    judged: &[&str],
    shape: Shape,
    rays: impl IntoIterator<Item = Ray>,
) -> ExamQuestion {
    let rays: Vec<Ray> = rays.into_iter().collect();
    let key = hits_key(judged, &rays, |ray64| scan::intersect(ray64, &shape));
    let shapes = vec![shape];
    ExamQuestion::new(Question::hits(Geometry::List { shapes }, rays), key)
}

/// Returns the key for a list of rays, where `answer` computes the correct answer for each ray.
pub fn hits_key(
    judged: &[&str],
    rays: &[Ray],
    answer: impl Fn(&Ray64) -> Option<Intersection>,
) -> Key {
    let hit = |ray: &Ray| Some(answer(&Ray64::from(ray))?.to_trace(ray));
    Key::table(judged, ExpectedRows::Hits(rays.iter().map(hit).collect()))
}
