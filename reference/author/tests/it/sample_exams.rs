//! Exams of a few seeds, generated once for all tests.

use std::sync::LazyLock;

use author::exams::assemble;
use author::items::traverse::RecordedPicture;
use author::seed::Seed;
use glam::{UVec2, Vec3};
use judging::exam::Exam;
use protocol::Question;

/// The seeds that the tests use.
pub const SEEDS: [u64; 3] = [2025, 77, 78];

/// The exam of each seed, with a placeholder for the path-traced picture.
static EXAMS: LazyLock<Vec<Exam>> = LazyLock::new(|| SEEDS.map(make_exam).into());

/// Returns the exam of one of the [`SEEDS`].
pub fn exam_of(seed: u64) -> &'static Exam {
    let index = SEEDS.iter().position(|other| *other == seed);
    &EXAMS[index.expect("the seed is in SEEDS")]
}

/// Generates an exam with a placeholder for the path-traced picture.
fn make_exam(seed: u64) -> Exam {
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
