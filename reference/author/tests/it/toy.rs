//! A second assignment fits in without a changed line: a table with two files, three tasks and one
//! substitution goes through the starter, the bundle, a package, grading and a class.

use std::fs;
use std::path::Path;

use author::bundle::secrets::{Leak, Secrets};
use author::bundle::{Bundle, archive};
use author::package::{self, Course, Platform};
use author::starter;
use class::cli::{ClassArguments, GradingArguments, Lists};
use class::grade::{Completion, grade_class};
use grader::doctor::package::problems;
use grader::grade::grade;
use grader::handed_out::{GivenFile, HandedOut, SubstitutedFile, TaskFile};
use grader::options::{Dependents, GradeOptions};
use grader::sandbox::Isolation;
use grader::score::Score;
use grader::select_isolation::IsolationRequest;
use judging::assignment::{Assignment, TaskClues, TaskInfo};
use serde_json::Value;
use tempfile::TempDir;

use crate::harness::{self, root};

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
            method: "hit",
            points: 40,
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "slab",
            title: "Task 2: a slab",
            file: "slab.rs",
            method: "hit",
            points: 20,
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "nearest",
            title: "Task 3: the nearest ball",
            file: "slab.rs",
            method: "nearest",
            points: 40,
            clues: TaskClues::NONE,
        },
    ],
    render: None,
    challenge: None,
};

/// Creates a given file of the toy, which is the same in the starter and in the solution.
macro_rules! given {
    ($name:literal) => {
        GivenFile {
            name: $name,
            text: include_str!(concat!("../toy/solved/src/", $name)),
        }
    };
}

static TOY: HandedOut = HandedOut {
    assignment: &TASKS,
    practice_exam: include_str!("../toy/practice.json"),
    files: &[
        TaskFile {
            name: "ball.rs",
            starter: include_str!("../toy/starter/ball.rs"),
            required_declarations: &["struct Ball", "fn hit"],
        },
        TaskFile {
            name: "slab.rs",
            starter: include_str!("../toy/starter/slab.rs"),
            required_declarations: &["struct Slab", "fn hit", "fn nearest"],
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
    reference: concat!(env!("CARGO_MANIFEST_DIR"), "/tests/toy/solved/src"),
    substitutions: &[SubstitutedFile {
        file: "slab.rs",
        parts: &["ball.rs"],
        given: &["world.rs"],
    }],
};

/// Returns the text of a file of the toy.
fn text(path: &str) -> String {
    harness::text(&format!("reference/author/tests/toy/{path}"))
}

/// Writes a submission with these texts in the folder `NAME/work`.
fn write_submission(class: &Path, name: &str, ball: &str, slab: &str) {
    let work = class.join(name).join("work");
    fs::create_dir_all(&work).unwrap();
    fs::write(work.join("ball.rs"), ball).unwrap();
    fs::write(work.join("slab.rs"), slab).unwrap();
}

fn options() -> GradeOptions {
    GradeOptions {
        handed_out: &TOY,
        isolation: IsolationRequest::Level(Isolation::None),
        ..GradeOptions::default()
    }
}

/// Grades the submission with these texts.
fn grade_texts(ball: &str, slab: &str, dependents: Dependents) -> Score {
    let folder = TempDir::new().unwrap();
    write_submission(folder.path(), "any", ball, slab);
    let graded = grade(&GradeOptions {
        submission: Some(folder.path().join("any")),
        out: Some(folder.path().join("out")),
        dependents,
        ..options()
    });
    graded.unwrap().score
}

fn points(score: &Score) -> Vec<u32> {
    score.tasks.iter().map(|task| task.points).collect()
}

#[test]
fn the_toy_is_graded_like_any_assignment() {
    let (solved_ball, solved_slab) = (text("solved/src/ball.rs"), text("solved/src/slab.rs"));
    let with_reference = Dependents::SubstituteReference;

    let solved = grade_texts(&solved_ball, &solved_slab, with_reference);
    assert_eq!(points(&solved), [40, 20, 40]);
    assert_eq!((solved.points, solved.max_points), (100, 100));

    let starter = grade_texts(
        &text("starter/ball.rs"),
        &text("starter/slab.rs"),
        with_reference,
    );
    assert_eq!(starter.points, 0);

    // A file that does not compile costs its own tasks only.
    let broken = grade_texts(
        &solved_ball,
        "struct Slab; fn hit() { fn nearest }",
        with_reference,
    );
    assert_eq!(points(&broken), [40, 0, 0]);
    assert_eq!(broken.build.not_compiled[0].file, "slab.rs");

    // A wrong ball costs the first task only, thanks to the reference's ball.
    let far_side = solved_ball.replace("middle - half", "middle + half");
    let wrong_ball = grade_texts(&far_side, &solved_slab, with_reference);
    assert_eq!(points(&wrong_ball), [0, 20, 40]);
    let blocked = grade_texts(&far_side, &solved_slab, Dependents::Block);
    assert_eq!(points(&blocked), [0, 20, 0]);
}

#[test]
fn a_class_of_toys_is_graded() {
    let folder = TempDir::new().unwrap();
    let class = folder.path().join("class");
    let (solved_ball, solved_slab) = (text("solved/src/ball.rs"), text("solved/src/slab.rs"));
    write_submission(&class, "ann", &solved_ball, &solved_slab);
    write_submission(&class, "bob", &solved_ball, &text("starter/slab.rs"));
    let out = folder.path().join("out");
    let arguments = ClassArguments {
        input: Some(class),
        out: Some(out.clone()),
        estimate: false,
        similarity_input: None,
        dry_run: false,
        regrade: false,
        shard: None,
        jobs: Some(1),
        grading: GradingArguments::default(),
        lists: Lists::default(),
    };
    let completion = grade_class(&arguments, &options()).unwrap();
    assert_eq!(completion, Completion::Complete);
    let points = |who: &str| {
        let file = out.join("students").join(who).join("score.json");
        let score: Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
        score["points"].as_u64().unwrap()
    };
    assert_eq!((points("ann"), points("bob")), (100, 40));
}

#[test]
fn an_exam_of_another_assignment_is_refused() {
    let folder = TempDir::new().unwrap();
    let exam = folder.path().join("toy.json");
    fs::write(&exam, TOY.practice_exam).unwrap();
    let rays = GradeOptions {
        exam: grader::exam_source::ExamSource::File(exam),
        ..GradeOptions::default()
    };
    let error = grade(&rays).unwrap_err().to_string();
    assert!(error.contains("it is for the assignment `toy`"), "{error}");
}

/// Returns how many lines of the bundle are lines of the toy's solution.
fn toy_leaks(secrets: &Secrets, bundle: &Bundle) -> usize {
    let leaks = secrets.search(bundle);
    let of_toy =
        |leak: &&Leak| matches!(leak, Leak::Line { source, .. } if source.contains("/toy/"));
    leaks.iter().filter(of_toy).count()
}

#[test]
fn the_starter_of_the_toy_is_a_projection_of_its_solution() {
    for file in starter::generated_files(&root(), &TOY).unwrap() {
        let name = file.path.rsplit('/').next().unwrap();
        let task_file = TOY.task_file(name).map(|file| file.starter);
        let given_file = TOY.given_file(name).map(|file| file.text);
        assert_eq!(Some(&*file.contents), task_file.or(given_file), "{name}");
    }
}

#[test]
fn the_bundle_and_the_package_of_the_toy_hold_its_starter_and_no_solution() {
    let bundle = Bundle::collect(&root(), &TOY, None).unwrap();
    let secrets = Secrets::gather(&root(), &TOY, &bundle).unwrap();
    assert_eq!(toy_leaks(&secrets, &bundle), 0);
    assert_eq!(
        bundle.text("student/src/slab.rs"),
        Some(&*text("starter/slab.rs"))
    );
    assert_eq!(bundle.text("student/src/camera.rs"), None);

    let mut leaking = bundle.clone();
    leaking.insert("handout/src/notes.md", text("solved/src/slab.rs"));
    assert!(toy_leaks(&secrets, &leaking) > 3);

    let course = Course::new(&TOY, None, None, None).unwrap();
    let package = package::collect(&root(), &TOY, Platform::Classroom50, course).unwrap();
    let archive = archive::unzip(&package.files["pathtracing.zip"]).unwrap();
    assert_eq!(
        archive.text("student/src/ball.rs"),
        Some(&*text("starter/ball.rs"))
    );
}

#[test]
fn a_template_of_the_toy_needs_its_own_files() {
    let folder = TempDir::new().unwrap();
    let workflow = folder.path().join(".github/workflows");
    fs::create_dir_all(&workflow).unwrap();
    fs::write(workflow.join("grade.yml"), "").unwrap();
    let found = problems(folder.path(), &TOY).unwrap().join("\n");
    assert!(found.contains("student/src/ball.rs"), "{found}");
    assert!(!found.contains("camera.rs"), "{found}");
}
