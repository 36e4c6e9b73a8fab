//! The toy: an assignment with two files, three tasks, a substitution, two mistakes and a variant.
//! A course can copy this folder to start its own assignment.

mod items;

use author::authoring::{Attack, Authoring};
use grader::handed_out::{GivenFile, HandedOut, SubstitutedFile};
use judging::assignment::{Assignment, TaskClues, TaskFile, TaskInfo};

/// The tasks.
static TASKS: Assignment = Assignment {
    id: "toy",
    title: "A toy",
    folders: &["", "work"],
    other_folders: &[],
    tasks: &[
        TaskInfo {
            id: "ball",
            title: "Task 1: a ball",
            file: "ball.rs",
            methods: &["Ball::hit"],
            points: 40,
            chapter: "sphere.md",
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "mirror",
            title: "Task 2: a mirror",
            file: "mirror.rs",
            methods: &["Mirror::reflect"],
            points: 20,
            chapter: "sphere.md",
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "nearest",
            title: "Task 3: the nearest ball",
            file: "mirror.rs",
            methods: &["nearest"],
            points: 40,
            chapter: "traversal.md",
            clues: TaskClues::NONE,
        },
    ],
    render: None,
    challenge: None,
};

/// Creates one of the toy's given files, which are the same in the starter and in the solution.
macro_rules! given {
    ($name:literal) => {
        GivenFile {
            name: $name,
            text: include_str!(concat!("solved/src/", $name)),
        }
    };
}

/// The files.
static HANDED_OUT: HandedOut = HandedOut {
    assignment: &TASKS,
    practice_exam: include_str!("practice.json"),
    files: &[
        TaskFile {
            name: "ball.rs",
            starter: include_str!("starter/ball.rs"),
            required_declarations: &["struct Ball", "fn hit"],
        },
        TaskFile {
            name: "mirror.rs",
            starter: include_str!("starter/mirror.rs"),
            required_declarations: &["struct Mirror", "fn reflect", "fn nearest"],
        },
    ],
    given: &[given!("lib.rs"), given!("world.rs")],
    main: given!("main.rs"),
    entry: "
fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&world::Student)
}
",
    student: "student",
    starter: "grader/starter",
    reference: "reference/author/tests/toy/solved/src",
    substitutions: &[SubstitutedFile {
        file: "mirror.rs",
        given: &["world.rs"],
        users: &[],
    }],
};

/// The toy as its authors see it.
pub static TOY: Authoring = Authoring {
    handed_out: &HANDED_OUT,
    practice_exam: "reference/author/tests/toy/practice.json",
    tasks: &[&items::BALL, &items::MIRROR, &items::NEAREST],
    oracles: &["reference/author/tests/toy/items.rs"],
    attacks: &[Attack {
        file: "ball.rs",
        method: "pub fn hit(&self, ray: &Ray) -> Option<Trace> {",
        entry: "D01-reads-files",
    }],
};
