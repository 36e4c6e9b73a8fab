//! The assignment `rays` as it is handed out.

use judging::assignment;

use super::{GivenFile, HandedOut, SubstitutedFile, TaskFile};

/// Creates a given file of the starter that is embedded in this program.
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
    files: &[
        TaskFile {
            name: "camera.rs",
            starter: include_str!("../../starter/camera.rs"),
            required_declarations: &["struct Camera", "fn new", "fn sample_ray"],
        },
        TaskFile {
            name: "triangle.rs",
            starter: include_str!("../../starter/triangle.rs"),
            required_declarations: &["struct Triangle", "fn new", "fn bbox", "fn hit"],
        },
        TaskFile {
            name: "sphere.rs",
            starter: include_str!("../../starter/sphere.rs"),
            required_declarations: &["struct Sphere", "fn new", "fn bbox", "fn hit"],
        },
        TaskFile {
            name: "bbox.rs",
            starter: include_str!("../../starter/bbox.rs"),
            required_declarations: &["struct BBox", "EMPTY", "fn new", "fn hit"],
        },
        TaskFile {
            name: "bvh.rs",
            starter: include_str!("../../starter/bvh.rs"),
            required_declarations: &[
                "struct Bvh",
                "struct Node",
                "fn leaf",
                "fn interior",
                "fn from_nodes",
                "fn build",
                "fn hit",
            ],
        },
    ],
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
    }],
};
