//! The exam's items: one file a task, one idea an item.
//!
//! An item's keys judge only what its idea is about. Every item asks for opposite answers (hits and
//! misses, one side and the other), so that no constant passes it.

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
use grader::exam::{ExamQuestion, HitCheck, Item, Key, Task};
use grader::signatures::MistakeSignatures;
use protocol::{Question, Ray, Rays, Shape};

use crate::oracle::{Intersection, Ray64, scan};

/// An item from its parts; `text` is its title, and where to look.
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

/// A ray between two points, as it is asked.
fn ray(from: DVec3, toward: DVec3) -> Ray {
    Ray::new(from.as_vec3(), (toward - from).as_vec3())
}

/// What the rays meet of all these shapes, each shape by its own `hit`.
fn shapes_question(judged: &[HitCheck], shapes: Vec<Shape>, rays: Vec<Ray>) -> ExamQuestion {
    let key = hits_key(judged, &rays, |beam| scan::closest_hit(beam, &shapes));
    let rays = Rays::List(rays);
    ExamQuestion::new(Question::Shapes { shapes, rays }, key)
}

/// The key to a list of rays.
fn hits_key(
    judged: &[HitCheck],
    rays: &[Ray],
    truth: impl Fn(&Ray64) -> Option<Intersection>,
) -> Key {
    let hit = |ray: &Ray| truth(&Ray64::from(ray)).map(|met| met.to_hit());
    Key::Hits {
        checks: judged.to_vec(),
        hits: rays.iter().map(hit).collect(),
    }
}
