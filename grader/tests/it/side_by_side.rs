//! A submission's score, report and page don't depend on whether its tasks run at the same time.
//! The grader runs them one after the other if an isolation level is requested.

use serde_json::Value;

use crate::harness::{GradeRun, Submission};

/// Code that never ends.
const HANG: &str = "while std::hint::black_box(true) {}";
/// Code that prints something.
const PRINT: &str = "println!(\"called\");";

/// Returns the submission with this code at the start of a method in a file.
fn with_start(submission: Submission, file: &str, code: &str) -> Submission {
    let mark = match file {
        "bvh.rs" => "        // starter: // Not written yet: this is a list without a tree.",
        "camera.rs" => "        // starter: todo!(\"task 1",
        "bbox.rs" => "        // starter: todo!(\"task 3",
        _ => "        // starter: todo!(\"task 2",
    };
    submission.with_replaced(file, mark, &format!("{code}\n{mark}"))
}

/// Asserts that both ways of running the tasks give the same outputs.
#[track_caller]
fn assert_same(submission: Submission) {
    let outputs = |graded: &GradeRun| {
        let mut score = graded.score();
        score["timings"] = Value::Null;
        (score.to_string(), graded.report(), graded.page().to_owned())
    };
    let limit = ["--cpu-limit", "1"];
    let together = submission.grade_with(&limit);
    let in_turn = submission.grade_with(&[limit, ["--isolation", "none"]].concat());
    assert_eq!(outputs(&together), outputs(&in_turn));
}

#[test]
fn wrong_answers_and_panics_are_the_same() {
    assert_same(Submission::starter("starter"));
    assert_same(Submission::panicking());
    assert_same(Submission::far_first("far-first"));
}

#[test]
fn what_each_task_prints_is_the_same() {
    let files = ["camera.rs", "sphere.rs", "bvh.rs"];
    let reference = Submission::reference("printing");
    assert_same(files.into_iter().fold(reference, |submission, file| {
        with_start(submission, file, PRINT)
    }));
}

#[test]
fn faults_in_several_tasks_are_the_same() {
    let overflow = "fn deeper(n: u64) -> u64 { std::hint::black_box(deeper(n + 1)) + n }
        if primitives.len() > 50 { deeper(0); }";
    let submission = Submission::exiting();
    let submission = with_start(submission, "sphere.rs", HANG);
    let submission = with_start(submission, "triangle.rs", "std::process::abort();");
    assert_same(with_start(submission, "bvh.rs", overflow));
}

#[test]
fn what_depends_on_a_task_that_hangs_is_the_same() {
    let submission = Submission::reference("hanging");
    assert_same(with_start(submission, "bbox.rs", HANG));
}
