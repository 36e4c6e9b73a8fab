//! A second assignment, the toy, works without any changes to the code. The tests cover the toy's
//! starter, its exam (with coverage, mistakes and proof), grading, a replay, a class, the bundle
//! and a package.
//!
//! `INSTA_UPDATE=always cargo test -p author --test it toy` writes the toy's generated files.

use std::path::Path;
use std::{env, fs};

use author::bundle::secrets::{Leak, Secrets};
use author::bundle::{Bundle, BundleOptions, archive};
use author::cli::{CheckArgs, Command, MistakesArgs, ProveArgs, RecordArgs};
use author::commands;
use author::exams::{final_exam_text, load_practice};
use author::items::shares_a_question;
use author::light::LightFiles;
use author::package::{self, CourseFiles, Platform};
use author::starter;
use class::cli::ClassArguments;
use class::grade::{Completion, grade_class};
use grader::doctor::package::problems;
use grader::exam_source::ExamSource;
use grader::grade::grade;
use grader::options::{Dependents, GradeOptions};
use grader::replay::replay;
use grader::sandbox::Isolation;
use grader::score::Score;
use grader::select_isolation::IsolationRequest;
use judging::exam::Exam;
use serde_json::Value;
use tempfile::TempDir;

use crate::harness::{self, lock_builds, root};

#[path = "../toy/assignment.rs"]
mod assignment;

use assignment::TOY;

/// Returns the text of one of the toy's files.
fn text(path: &str) -> String {
    harness::text(&format!("reference/author/tests/toy/{path}"))
}

/// Writes a submission's two files to the folder `NAME/work`.
fn write_submission(class: &Path, name: &str, ball: &str, mirror: &str) {
    let work = class.join(name).join("work");
    fs::create_dir_all(&work).unwrap();
    fs::write(work.join("ball.rs"), ball).unwrap();
    fs::write(work.join("mirror.rs"), mirror).unwrap();
}

fn options() -> GradeOptions {
    GradeOptions {
        handed_out: TOY.handed_out,
        isolation: IsolationRequest::Level(Isolation::None),
        ..GradeOptions::default()
    }
}

/// Grades a submission whose files have these texts.
fn grade_texts(ball: &str, mirror: &str, dependents: Dependents) -> Score {
    let folder = TempDir::new().unwrap();
    write_submission(folder.path(), "any", ball, mirror);
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
    let (solved_ball, solved_mirror) = (text("solved/src/ball.rs"), text("solved/src/mirror.rs"));
    let with_reference = Dependents::SubstituteReference;

    let solved = grade_texts(&solved_ball, &solved_mirror, with_reference);
    assert_eq!(points(&solved), [40, 20, 40]);
    assert_eq!((solved.points, solved.max_points), (100, 100));

    let starter = grade_texts(
        &text("starter/ball.rs"),
        &text("starter/mirror.rs"),
        with_reference,
    );
    assert_eq!(starter.points, 0);

    // If a file doesn't compile, only its own tasks lose points.
    let broken = grade_texts(
        &solved_ball,
        "struct Mirror; fn reflect() { fn nearest }",
        with_reference,
    );
    assert_eq!(points(&broken), [40, 0, 0]);
    assert_eq!(broken.build.not_compiled[0].file, "mirror.rs");

    // If the ball is wrong, only the first task loses points, because the other tasks are graded
    // with the reference's ball.
    let far_side = solved_ball.replace("middle - half", "middle + half");
    let wrong_ball = grade_texts(&far_side, &solved_mirror, with_reference);
    assert_eq!(points(&wrong_ball), [0, 20, 40]);
    let blocked = grade_texts(&far_side, &solved_mirror, Dependents::Block);
    assert_eq!(points(&blocked), [0, 20, 0]);
}

#[test]
fn a_report_and_a_replay_show_a_known_mistake() {
    let folder = TempDir::new().unwrap();
    let far_side = text("solved/src/ball.rs").replace("middle - half", "middle + half");
    write_submission(folder.path(), "any", &far_side, &text("starter/mirror.rs"));
    let options = GradeOptions {
        submission: Some(folder.path().join("any")),
        out: Some(folder.path().join("out")),
        ..options()
    };
    grade(&options).unwrap();
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(page.contains("Task 3: the nearest ball"), "{page}");
    let nudge = "Which of the two do you return?";
    assert!(page.contains(nudge), "{page}");
    let replayed = replay(&options, &"ball.near_side".parse().unwrap()).unwrap();
    assert!(replayed.contains("distance"), "{replayed}");
}

/// The toy's exam, mistakes, coverage and proof come from the same commands as any assignment's.
#[test]
fn the_generated_files_of_the_toy_are_in_sync_and_its_exam_is_proven() {
    let _lock = lock_builds();
    let is_update = env::var("INSTA_UPDATE").is_ok_and(|value| value == "always");
    let check = CheckArgs { check: !is_update };
    let record = RecordArgs { record: false };
    let mistakes = MistakesArgs {
        seeds: None,
        table: false,
        task: None,
        check,
        record,
    };
    let prove = ProveArgs {
        seeds: 1..4,
        mistakes: 3,
        variant: None,
        record,
    };
    for command in [
        Command::Exams(check),
        Command::Mistakes(mistakes),
        Command::Coverage(check),
        Command::Prove(prove),
    ] {
        commands::run(command, &TOY).unwrap();
    }
}

#[test]
fn a_seed_gives_a_final_exam_of_the_toy_with_other_questions() {
    let _lock = lock_builds();
    let exam: Exam = serde_json::from_str(&final_exam_text(&TOY, 7).unwrap()).unwrap();
    let practice = load_practice(&root(), &TOY).unwrap();
    assert_eq!((&*exam.assignment, &*exam.id), ("toy", "final"));
    for (item, other) in exam.items.iter().zip(&practice.items) {
        assert_eq!(item.id, other.id);
        assert!(!shares_a_question(item, other), "{}", item.id);
    }
}

#[test]
fn a_class_of_toys_is_graded() {
    let folder = TempDir::new().unwrap();
    let class = folder.path().join("class");
    let (solved_ball, solved_mirror) = (text("solved/src/ball.rs"), text("solved/src/mirror.rs"));
    write_submission(&class, "ann", &solved_ball, &solved_mirror);
    write_submission(&class, "bob", &solved_ball, &text("starter/mirror.rs"));
    let out = folder.path().join("out");
    let arguments = ClassArguments {
        input: Some(class),
        out: Some(out.clone()),
        jobs: Some(1),
        ..ClassArguments::default()
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
    fs::write(&exam, TOY.handed_out.practice_exam).unwrap();
    let rays = GradeOptions {
        exam: ExamSource::File(exam),
        ..GradeOptions::default()
    };
    let error = grade(&rays).unwrap_err().to_string();
    assert!(error.contains("it is for the assignment `toy`"), "{error}");
}

/// Returns the number of lines in the bundle that come from the toy's solution.
fn toy_leaks(secrets: &Secrets, bundle: &Bundle) -> usize {
    let leaks = secrets.search(bundle);
    let of_toy =
        |leak: &&Leak| matches!(leak, Leak::Line { source, .. } if source.contains("/toy/"));
    leaks.iter().filter(of_toy).count()
}

#[test]
fn the_starter_of_the_toy_is_a_projection_of_its_solution() {
    for file in starter::generated_files(&root(), TOY.handed_out).unwrap() {
        let name = file.path.rsplit('/').next().unwrap();
        let task_file = TOY.handed_out.task_file(name).map(|file| file.starter);
        let given_file = TOY.handed_out.given_file(name).map(|file| file.text);
        assert_eq!(Some(&*file.contents), task_file.or(given_file), "{name}");
    }
}

#[test]
fn the_bundle_and_the_package_of_the_toy_hold_its_starter_and_no_solution() {
    let bundle = Bundle::collect(&root(), TOY.handed_out, BundleOptions::default()).unwrap();
    let secrets = Secrets::gather(&root(), &TOY, LightFiles::Solved, &bundle).unwrap();
    assert_eq!(toy_leaks(&secrets, &bundle), 0);
    assert_eq!(
        bundle.text("student/src/mirror.rs"),
        Some(&*text("starter/mirror.rs"))
    );
    assert_eq!(bundle.text("student/src/camera.rs"), None);

    let mut leaking = bundle.clone();
    leaking.insert("handout/src/notes.md", text("solved/src/mirror.rs"));
    assert!(toy_leaks(&secrets, &leaking) > 1);

    let course = CourseFiles::new(&TOY, None, None, None, LightFiles::Solved).unwrap();
    let package = package::collect(&root(), TOY.handed_out, Platform::Classroom50, course).unwrap();
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
    let found = problems(folder.path(), TOY.handed_out).unwrap().join("\n");
    assert!(found.contains("student/src/ball.rs"), "{found}");
    assert!(!found.contains("camera.rs"), "{found}");
}
