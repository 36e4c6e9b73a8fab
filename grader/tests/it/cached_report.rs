//! The cached report: an unchanged submission is graded once, unless `--fresh` is given.

use std::fs;
use std::path::PathBuf;

use crate::formats::small_exam;
use crate::harness::{Submission, grader, workspace};

const NOTICE: &str = "Nothing has changed since this was graded";

/// Grades a submission with a small exam into the default output folder. Returns the output.
fn grade_output(submission: &Submission, arguments: &[&str]) -> String {
    let exam_file = submission.path().join("../exam.json");
    fs::write(&exam_file, small_exam("few")).unwrap();
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

/// Returns the default output folder of a submission with this name. Deletes the folder if an
/// earlier run left one.
fn clean_output_folder(name: &str) -> PathBuf {
    let folder = workspace().join("target/grade").join(name);
    fs::remove_dir_all(&folder).ok();
    folder
}

#[test]
fn prints_the_cached_report_if_nothing_changed() {
    let folder = clean_output_folder("cached-unchanged");
    let submission = Submission::reference("cached-unchanged");
    let first = grade_output(&submission, &[]);
    let score = fs::read(folder.join("score.json")).unwrap();
    let second = grade_output(&submission, &[]);
    assert!(
        !first.contains(NOTICE) && second.contains(NOTICE),
        "{second}"
    );
    assert_eq!(
        lines_without(&second, NOTICE),
        lines_without(&first, NOTICE),
        "otherwise the output is the same"
    );
    assert_eq!(fs::read(folder.join("score.json")).unwrap(), score);
    assert!(!grade_output(&submission, &["--fresh"]).contains(NOTICE));

    // `--require` does not affect the score, so the cached report is printed.
    assert!(grade_output(&submission, &["--require", "1"]).contains(NOTICE));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn grades_again_after_any_change() {
    let folder = clean_output_folder("cached-changed");
    let submission = Submission::reference("cached-changed");
    grade_output(&submission, &[]);
    assert!(
        !grade_output(&submission, &["--hints"]).contains(NOTICE),
        "options"
    );
    grade_output(&submission, &[]);
    fs::write(folder.join("score.json"), "{\"points\": 100}").unwrap();
    assert!(
        !grade_output(&submission, &[]).contains(NOTICE),
        "the score"
    );
    fs::write(folder.join("earlier.json"), "{\"key\": ").unwrap();
    assert!(
        !grade_output(&submission, &[]).contains(NOTICE),
        "half a record"
    );
    assert!(grade_output(&submission, &[]).contains(NOTICE), "nothing");
    let submission =
        submission.with_replaced("sphere.rs", "discriminant < 0.0", "discriminant < 1e-9");
    assert!(!grade_output(&submission, &[]).contains(NOTICE), "a file");
    fs::remove_dir_all(folder).unwrap();
}

/// Returns the lines that do not contain `word` and are not empty.
fn lines_without<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    let lines = text.lines().filter(|line| !line.is_empty());
    lines.filter(|line| !line.contains(word)).collect()
}
