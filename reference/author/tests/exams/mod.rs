//! Exams of some seeds, made once for all tests of a file.
#![allow(dead_code, reason = "each test file uses its own part of this")]

use std::sync::LazyLock;

use author::exams::assemble;
use author::recording::RecordedPicture;
use author::seed::Seed;
use glam::{UVec2, Vec3};
use grader::exam::Exam;
use protocol::Question;

/// What is true must be so with each of them.
pub const SEEDS: [u64; 3] = [2025, 77, 78];

/// An exam of each seed; their pictures of radiance are none.
static EXAMS: LazyLock<Vec<Exam>> = LazyLock::new(|| SEEDS.map(make_exam).into());

/// The exam of one of the seeds.
pub fn exam_of(seed: u64) -> &'static Exam {
    let place = SEEDS.iter().position(|other| *other == seed);
    &EXAMS[place.expect("one of the seeds")]
}

/// An exam without a picture of radiance.
pub fn make_exam(seed: u64) -> Exam {
    let question = Question::Radiance {
        scene: String::new(),
        film: UVec2::ONE,
        samples: 1,
        bounces: 1,
        seed,
    };
    let recorded = RecordedPicture {
        question,
        pixels: vec![Vec3::ONE],
    };
    assemble("test", Seed(seed), recorded)
}
