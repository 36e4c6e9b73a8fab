//! The assignment `light` as its authors see it.

use grader::handed_out;

use super::{Attack, Authoring};
use crate::items::light;

/// The assignment `light`.
pub static LIGHT: Authoring = Authoring {
    handed_out: &handed_out::LIGHT,
    practice_exam: "grader/exams/light.json",
    tasks: light::TASKS,
    oracles: &[
        "reference/author/src/oracle/light",
        "reference/author/src/items/light",
    ],
    attacks: &[Attack {
        file: "path.rs",
        method: "pub fn radiance(world: &World, ray: Ray, sampler: &Sampler, bounces: u32) -> Vec3 {",
        entry: "D01-reads-files",
    }],
};
