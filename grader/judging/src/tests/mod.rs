//! Tests of the whole package, with the practice exam.

mod answers;
mod exams;
mod misses;
mod properties;

use std::path::Path;
use std::sync::LazyLock;

use crate::assignment::RAYS;
use crate::exam::Exam;
use crate::exam_file;

/// The practice exam.
static EXAM: LazyLock<Exam> = LazyLock::new(|| {
    let bytes = include_bytes!("../../../exams/practice.json");
    let file = exam_file::parse(Path::new("practice.json"), bytes, &RAYS);
    file.unwrap().exam
});

/// Some items of the practice exam, with each kind of question and key: faster to read than all of it.
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
    }
    exam
});
