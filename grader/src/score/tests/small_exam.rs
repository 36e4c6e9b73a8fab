//! A small exam for tests, with handmade items of one or two questions.

use glam::Vec3;
use judging::exam::{Exam, ExamQuestion, Item, Key};
use judging::exam_file::ExamName;
use judging::section::Section;
use protocol::{Corners, Interval, Query, Question, Ray};

use crate::handed_out::RAYS;
use crate::score::Score;
use crate::verdict::pending_score;

/// Returns a question that asks about a box and this many rays.
pub fn boxes(rays: u8) -> ExamQuestion {
    let query = |x| Query {
        ray: Ray::new(Vec3::new(f32::from(x), 0.0, 0.0), Vec3::X),
        times: Interval::AHEAD,
    };
    let (min, max) = (Vec3::ZERO, Vec3::ONE);
    let queries = (0..rays).map(query).collect();
    ExamQuestion::new(
        Question::boxes(Corners { min, max }, queries),
        Key::spans((0..rays).map(|_| None).collect()),
    )
}

/// Returns an item with these questions, worth 4 points.
pub fn item(id: &str, questions: Vec<ExamQuestion>) -> Item {
    Item {
        title: format!("title of {id}"),
        look: "look here".to_owned(),
        section: Some(Section::new("boxes.md#a-heading")),
        ..Item::new(id, 4, questions)
    }
}

/// Returns an exam of items with these ids, each worth 4 points.
pub fn exam(ids: &[&str]) -> Exam {
    let items = ids.iter().map(|id| item(id, vec![boxes(1)]));
    Exam::new(RAYS.assignment, "small", items.collect())
}

/// Returns a submission's score in this exam before any item is graded.
pub fn pending(exam: &Exam) -> Score {
    let name = ExamName {
        id: exam.id.clone(),
        hash: "0123".to_owned(),
    };
    pending_score(exam, name, "alice", &RAYS)
}
