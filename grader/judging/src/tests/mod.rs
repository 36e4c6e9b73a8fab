//! Tests of the whole package, with the practice exam.

mod answers;
mod exams;
mod misses;
mod properties;

use std::path::Path;
use std::sync::LazyLock;

use glam::{UVec2, Vec2, Vec3};
use protocol::{Corners, Interval, Query, Question, Ray, Rows, Shape, Trace};

use crate::assignment::RAYS;
use crate::exam::{Exam, ExamQuestion, ExpectedRows, Key};
use crate::exam_file;

/// Any hit.
pub const HIT: Trace = Trace {
    distance: 1.0,
    position: Vec3::X,
    normal: Vec3::X,
    uv: Vec2::ZERO,
    origin: Vec3::ZERO,
    shape: 0,
};

pub fn sphere(center: Vec3, radius: f32) -> Shape {
    Shape::Sphere {
        center,
        radius,
        shape: 0,
    }
}

/// Returns a question about the intervals these rays spend inside a box.
pub fn boxes(min: Vec3, max: Vec3, rays: &[Ray]) -> Question {
    let times = Interval::AHEAD;
    let queries = rays.iter().map(|&ray| Query { ray, times });
    Question::boxes(Corners { min, max }, queries.collect())
}

/// The practice exam.
static EXAM: LazyLock<Exam> = LazyLock::new(|| {
    let bytes = include_bytes!("../../../exams/practice.json");
    let file = exam_file::parse(Path::new("practice.json"), bytes, &RAYS);
    file.unwrap().exam
});

/// Items of the practice exam that together cover every kind of question and key. They load faster
/// than the whole exam.
pub static PART: LazyLock<Exam> = LazyLock::new(|| {
    let mut exam = EXAM.clone();
    exam.items.retain(|item| {
        [
            "camera.corners",
            "camera.picture",
            "sphere.near_side",
            "bbox.through",
            "build.one_or_none",
            "traverse.no_nodes",
            "triangle.picture",
            "traverse.radiance",
        ]
        .contains(&item.id.as_str())
    });
    for item in &mut exam.items {
        item.needs.clear();
        item.questions
            .iter_mut()
            .for_each(make_picture_of_rays_small);
    }
    exam
});

/// Reduces a picture of camera rays to a few pixels. Its thousands of rays make up half of the
/// exam's text.
fn make_picture_of_rays_small(question: &mut ExamQuestion) {
    if let (
        Question::SampleRay(table),
        Key::Table {
            rows: ExpectedRows::Rays(directions),
            ..
        },
    ) = (&mut question.question, &mut question.key)
        && let Rows::Picture(film) = &mut table.rows
    {
        *film = UVec2::splat(4);
        table.subject.film = *film;
        directions.truncate(table.rows.count());
    }
}
