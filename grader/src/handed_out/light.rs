//! The assignment `light` as handed out to students.

use judging::assignment;

use super::{GivenFile, HandedOut, SubstitutedFile};

/// Creates a `GivenFile` from one of the starter's files and embeds its text in this program.
macro_rules! given {
    ($name:literal) => {
        GivenFile {
            name: $name,
            text: include_str!(concat!("../../starter/light/", $name)),
        }
    };
}

/// The assignment `light`.
pub static LIGHT: HandedOut = HandedOut {
    assignment: &assignment::LIGHT,
    practice_exam: include_str!("../../exams/light.json"),
    files: assignment::LIGHT_FILES,
    given: &[
        given!("lib.rs"),
        given!("world.rs"),
        given!("integrator.rs"),
        given!("exam.rs"),
    ],
    main: given!("main.rs"),
    entry: "
/// Answers the grader's questions.
fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&exam::Student)
}
",
    student: "student/light",
    starter: "grader/starter/light",
    reference: "reference/light/src",
    substitutions: &[
        SubstitutedFile {
            file: "direct.rs",
            given: &["exam.rs"],
            users: &["path.rs", "integrator.rs"],
        },
        SubstitutedFile {
            file: "path.rs",
            given: &["exam.rs"],
            users: &["integrator.rs"],
        },
    ],
};
