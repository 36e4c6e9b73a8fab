//! The cached report: an unchanged submission is only graded once, unless `--fresh` is passed.

use std::fs;
use std::path::PathBuf;

use crate::formats::small_exam;
use crate::harness::{Submission, grader, workspace};

const NOTICE: &str = "Nothing has changed since this was graded";

/// Grades a submission with a small exam into the default output folder. Returns the output.
fn grade_output(submission: &Submission, arguments: &[&str]) -> String {
    let exam = submission.file_option("--exam", "../exam.json", small_exam("few"));
    let mut command = grader();
    command.arg(submission.path()).arg("--no-reference");
    let output = command.args(exam).args(arguments).output().unwrap();
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
    assert!(!first.contains(NOTICE), "{first}");
    assert!(second.contains(NOTICE), "{second}");
    // The rest of the output is the same.
    assert_eq!(lines_of_grading(&second), lines_of_grading(&first));
    assert_eq!(fs::read(folder.join("score.json")).unwrap(), score);
    assert!(!grade_output(&submission, &["--fresh"]).contains(NOTICE));

    // `--require` doesn't affect the score, so the cached report is printed.
    assert!(grade_output(&submission, &["--require", "1"]).contains(NOTICE));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn grades_again_after_any_change() {
    let folder = clean_output_folder("cached-changed");
    let submission = Submission::reference("cached-changed");
    let is_cached = |submission: &Submission, arguments: &[&str]| {
        grade_output(submission, arguments).contains(NOTICE)
    };
    grade_output(&submission, &[]);
    assert!(!is_cached(&submission, &["--hints"]), "options");
    grade_output(&submission, &[]);
    fs::write(folder.join("score.json"), "{\"points\": 100}").unwrap();
    assert!(!is_cached(&submission, &[]), "the score");
    fs::write(folder.join("earlier.json"), "{\"key\": ").unwrap();
    assert!(!is_cached(&submission, &[]), "half a record");
    assert!(is_cached(&submission, &[]), "nothing");
    let submission =
        submission.with_replaced("sphere.rs", "discriminant < 0.0", "discriminant < 1e-9");
    assert!(!is_cached(&submission, &[]), "a file");
    fs::remove_dir_all(folder).unwrap();
}

/// Returns the lines of an output, except for the notice and any empty lines.
fn lines_of_grading(text: &str) -> Vec<&str> {
    let lines = text.lines().filter(|line| !line.is_empty());
    lines.filter(|line| !line.contains(NOTICE)).collect()
}
