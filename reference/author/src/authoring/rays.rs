//! The assignment `rays` as its authors see it.

use grader::handed_out;

use super::{Attack, Authoring};
use crate::items;

/// The assignment `rays`.
pub static RAYS: Authoring = Authoring {
    handed_out: &handed_out::RAYS,
    practice_exam: "grader/exams/practice.json",
    tasks: items::TASKS,
    oracles: &["reference/author/src/oracle", "reference/author/src/items"],
    attacks: &[
        Attack {
            file: "camera.rs",
            method: "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {",
            entry: "B01-includes-the-key",
        },
        Attack {
            file: "sphere.rs",
            method: "pub fn hit(&self, ray: &Ray) -> Option<Trace> {",
            entry: "D01-reads-files",
        },
    ],
};
