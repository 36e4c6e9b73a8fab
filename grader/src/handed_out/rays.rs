//! The assignment `rays` as handed out to students.

use judging::assignment;

use super::{GivenFile, HandedOut, SubstitutedFile};

/// Creates a `GivenFile` from one of the starter's files and embeds its text in this program.
macro_rules! given {
    ($name:literal) => {
        GivenFile {
            name: $name,
            text: include_str!(concat!("../../starter/", $name)),
        }
    };
}

/// The assignment `rays`.
pub static RAYS: HandedOut = HandedOut {
    assignment: &assignment::RAYS,
    practice_exam: include_str!("../../exams/practice.json"),
    files: assignment::RAYS_FILES,
    given: &[given!("lib.rs"), given!("primitive.rs"), given!("world.rs")],
    main: given!("main.rs"),
    entry: "
/// Answers the grader's questions.
fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&world::Student)
}
",
    student: "student",
    starter: "grader/starter",
    reference: "reference/src",
    substitutions: &[SubstitutedFile {
        file: "bvh.rs",
        given: &["world.rs"],
        users: &[],
    }],
};
