//! The exam's items: one module per task, and one idea per item.
//!
//! An item's keys test only the quantities that its idea is about. Every item has questions with
//! opposite answers (such as hits and misses), so that no constant answer passes it.

pub mod bbox;
pub mod build;
pub mod camera;
pub mod meshes;
pub mod picture;
pub mod sections;
pub mod sphere;
pub mod traverse;
pub mod triangle;

use glam::DVec3;
use judging::exam::{ExamQuestion, HitCheck, Item, Key, Task};
use judging::signatures::MistakeSignatures;
use protocol::{Question, Ray, Rays, Shape};

use crate::oracle::{Intersection, Ray64, scan};

/// Creates an item. `text` contains its title, and advice on where to look for the mistake.
fn item(
    task: Task,
    name: &str,
    points: u32,
    text: [&str; 2],
    questions: impl IntoIterator<Item = ExamQuestion>,
) -> Item {
    let [title, look] = text.map(str::to_owned);
    let id = format!("{task}.{name}");
    Item {
        section: sections::section(&id),
        id,
        title,
        task,
        points,
        look,
        needs: Vec::new(),
        questions: questions.into_iter().collect(),
        signatures: MistakeSignatures::default(),
    }
}

/// Returns the ray from one point toward another, in single precision.
fn ray(from: DVec3, toward: DVec3) -> Ray {
    Ray::new(from.as_vec3(), (toward - from).as_vec3())
}

/// Creates a question that asks for the closest hit of each ray. It calls the `hit` of every shape,
/// without a tree.
fn shapes_question(checks: &[HitCheck], shapes: Vec<Shape>, rays: Vec<Ray>) -> ExamQuestion {
    let key = hits_key(checks, &rays, |ray64| scan::closest_hit(ray64, &shapes));
    let rays = Rays::List(rays);
    ExamQuestion::new(Question::Shapes { shapes, rays }, key)
}

/// Returns the key for a list of rays, where `answer` computes the correct answer for each ray.
fn hits_key(
    checks: &[HitCheck],
    rays: &[Ray],
    answer: impl Fn(&Ray64) -> Option<Intersection>,
) -> Key {
    let key = |ray: &Ray| answer(&Ray64::from(ray)).map(|intersection| intersection.to_hit());
    Key::Hits {
        checks: checks.to_vec(),
        hits: rays.iter().map(key).collect(),
    }
}
