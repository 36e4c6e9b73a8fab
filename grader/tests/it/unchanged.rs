//! A submission is graded once as it is, unless somebody wants it anew.

use std::fs;
use std::path::PathBuf;

use crate::formats::exam;
use crate::harness::{Submission, grader, workspace};

const WORD: &str = "Nothing has changed since this was graded";

/// Grades it with few items, in its usual place; what was said.
fn graded(submission: &Submission, arguments: &[&str]) -> String {
    let exam_file = submission.path().join("../exam.json");
    fs::write(&exam_file, exam("few")).unwrap();
    let output = grader()
        .arg(submission.path())
        .args(["--no-reference", "--exam"])
        .arg(exam_file)
        .args(arguments)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The usual place, as if nothing of this name had been graded yet.
fn usual_place(name: &str) -> PathBuf {
    let place = workspace().join("target/grade").join(name);
    fs::remove_dir_all(&place).ok();
    place
}

#[test]
fn what_was_graded_is_told_again_and_not_graded_again() {
    let place = usual_place("told-again");
    let submission = Submission::reference("told-again");
    let first = graded(&submission, &[]);
    let score = fs::read(place.join("score.json")).unwrap();
    let second = graded(&submission, &[]);
    assert!(!first.contains(WORD) && second.contains(WORD), "{second}");
    assert_eq!(
        without(&second, WORD),
        without(&first, WORD),
        "but for that, the same is said"
    );
    assert_eq!(fs::read(place.join("score.json")).unwrap(), score);
    assert!(!graded(&submission, &["--fresh"]).contains(WORD));

    // What it is required to have is no part of the score.
    assert!(graded(&submission, &["--require", "1"]).contains(WORD));
    fs::remove_dir_all(place).unwrap();
}

#[test]
fn whatever_else_is_changed_is_graded() {
    let place = usual_place("graded-anew");
    let submission = Submission::reference("graded-anew");
    graded(&submission, &[]);
    assert!(!graded(&submission, &["--hints"]).contains(WORD), "options");
    graded(&submission, &[]);
    fs::write(place.join("score.json"), "{\"points\": 100}").unwrap();
    assert!(!graded(&submission, &[]).contains(WORD), "the score");
    fs::write(place.join("earlier.json"), "{\"key\": ").unwrap();
    assert!(!graded(&submission, &[]).contains(WORD), "half a record");
    assert!(graded(&submission, &[]).contains(WORD), "nothing");
    let submission = submission.changed("sphere.rs", "discriminant < 0.0", "discriminant < 1e-9");
    assert!(!graded(&submission, &[]).contains(WORD), "a file");
    fs::remove_dir_all(place).unwrap();
}

#[test]
fn what_may_go_otherwise_next_time_is_graded_next_time() {
    let place = usual_place("crashing-again");
    let head = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let crash = format!("{head}\n        std::process::abort();");
    let submission = Submission::reference("crashing-again").changed("sphere.rs", head, &crash);
    let report = graded(&submission, &[]);
    assert!(report.contains("crashed"), "{report}");
    assert!(!graded(&submission, &[]).contains(WORD));
    fs::remove_dir_all(place).unwrap();
}

/// The lines that do not hold this, nor are empty.
fn without<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    let lines = text.lines().filter(|line| !line.is_empty());
    lines.filter(|line| !line.contains(word)).collect()
}
