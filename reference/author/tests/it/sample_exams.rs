//! Exams of a few seeds, generated once for all tests.

use std::sync::LazyLock;

use author::authoring::RAYS;
use author::exams::assemble;
use author::seed::Seed;
use judging::exam::Exam;

/// The seeds that the tests use.
pub const SEEDS: [u64; 3] = [2025, 77, 78];

/// The exam of each seed, without its recorded picture.
static EXAMS: LazyLock<Vec<Exam>> = LazyLock::new(|| SEEDS.map(make_exam).into());

/// Returns the exam of one of the [`SEEDS`].
pub fn exam_of(seed: u64) -> &'static Exam {
    let index = SEEDS.iter().position(|other| *other == seed);
    &EXAMS[index.expect("the seed is in SEEDS")]
}

/// Generates an exam without recording its path-traced picture.
fn make_exam(seed: u64) -> Exam {
    assemble(&RAYS, "test", Seed(seed))
}
