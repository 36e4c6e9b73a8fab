//! A submission may contain several assignments. Each is graded separately.

use std::fs;
use std::path::Path;

use grader::handed_out::LIGHT;
use serde_json::Value;
use tempfile::TempDir;

use crate::harness::{assert_fails, grader, workspace};

/// Creates a folder with a submission that contains files of both assignments, from these folders
/// of the workspace.
fn submission(rays: Option<&str>, light: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    let copy = |source: &Path, below: &str| {
        let target = folder.path().join("both").join(below);
        fs::create_dir_all(&target).unwrap();
        for entry in fs::read_dir(source).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, target.join(path.file_name().unwrap())).unwrap();
            }
        }
    };
    if let Some(rays) = rays {
        copy(&workspace().join(rays), "src");
    }
    copy(&workspace().join(light), "light/src");
    folder
}

/// Runs the grader on a submission. Returns the exit code and the report.
fn grade(submission: &TempDir, arguments: &[&str]) -> std::process::Output {
    let mut command = grader();
    command.arg(submission.path().join("both")).args(arguments);
    command.output().unwrap()
}

fn text(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn each_assignment_that_was_started_gets_its_own_score() {
    let folder = submission(Some("grader/starter"), "reference/light/src");
    let output = grade(&folder, &["--no-reference", "--fresh"]);
    let report = text(&output);
    assert_eq!(output.status.code(), Some(0), "{report}");
    let scores: Vec<&str> = report
        .lines()
        .filter(|line| line.contains("practice exam"))
        .map(|line| line.rsplit("  ").next().unwrap().trim())
        .collect();
    assert_eq!(scores, ["0 / 100", "100 / 100"], "{report}");
    for (file, task, points) in [
        ("target/grade/both/score.json", "camera", 0),
        ("target/grade/both/light/score.json", "lambertian", 100),
    ] {
        let score = fs::read(workspace().join(file)).unwrap();
        let score: Value = serde_json::from_slice(&score).unwrap();
        assert_eq!(score["tasks"][0]["id"], task, "{file}");
        assert_eq!(score["points"], points, "{file}");
    }
}

#[test]
fn an_assignment_that_was_not_started_is_not_graded() {
    let folder = submission(Some("grader/starter"), "grader/starter/light");
    let out = folder.path().join("out");
    let output = grade(&folder, &["--out", out.to_str().unwrap()]);
    assert!(
        !text(&output).contains("Matte surfaces"),
        "{}",
        text(&output)
    );
    // It is graded if it is asked for.
    let output = grade(
        &folder,
        &["--out", out.to_str().unwrap(), "--assignment", "light"],
    );
    assert!(text(&output).contains("0 / 100"), "{}", text(&output));
}

#[test]
fn only_the_assignment_in_the_submission_is_graded() {
    let folder = submission(None, "reference/light/src");
    let out = folder.path().join("out");
    let output = grade(
        &folder,
        &["--out", out.to_str().unwrap(), "--require", "100"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
}

#[test]
fn options_for_one_assignment_need_to_know_which() {
    let folder = submission(Some("grader/starter"), "reference/light/src");
    let out = folder.path().join("out");
    let out = ["--out", out.to_str().unwrap()];
    for option in [&["--require", "50"][..], &["--format", "json"], &out] {
        let output = grade(&folder, option);
        let why = format!(
            "{} works with only one assignment, but several have been started: add --assignment \
             rays or --assignment light",
            option[0]
        );
        assert_fails(&output, 2, &why);
    }
    let with_assignment = [&out[..], &["--require", "50", "--assignment", "light"]].concat();
    assert_eq!(grade(&folder, &with_assignment).status.code(), Some(0));
}

#[test]
fn a_task_says_which_assignment_is_meant() {
    let folder = submission(Some("grader/starter"), "reference/light/src");
    for task in LIGHT.assignment.tasks {
        let report = text(&grade(&folder, &["--task", task.id]));
        assert!(report.contains(task.title), "{report}");
    }
    let report = text(&grade(&folder, &["--replay", "specular.reflect#1"]));
    assert!(report.contains("reflect"), "{report}");
}
