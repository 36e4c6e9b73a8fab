//! An exam that can not be asked is refused before anything is, with the place and what to do.

use std::io::Write;
use std::process::Stdio;

use insta::assert_snapshot;

use crate::harness::{Submission, grader};

/// A good exam of one item.
const GOOD: &str = r#"{
  "schema": 1,
  "id": "small",
  "items": [
    {
      "id": "bbox.through",
      "title": "a ray goes through a box",
      "task": "bbox",
      "points": 5,
      "look": "Inside all three slabs at once.",
      "questions": [
        {
          "question": { "bbox": { "min": [-1, -1, -1], "max": [1, 1, 1], "shots": [
            [{ "origin": [-3, 0, 0], "dir": [1, 0, 0], "range": [0, null] }, [0, null]],
            [{ "origin": [-3, 0, 0], "dir": [-1, 0, 0], "range": [0, null] }, [0, null]]
          ] } },
          "key": { "spans": { "spans": [[2, 4], null] } }
        }
      ]
    }
  ]
}"#;

fn refused(exam: impl AsRef<[u8]>) -> String {
    let submission = Submission::reference("any").with("exam.json", exam);
    let path = submission.path().join("exam.json");
    let graded = submission.grade_with(&["--exam", path.to_str().unwrap()]);
    assert_eq!(graded.exit_code(), 2, "{}", graded.error());
    assert!(graded.score.is_none(), "nothing was asked");
    graded.error().replace(path.to_str().unwrap(), "exam.json")
}

#[test]
fn a_good_one_is_asked() {
    let submission = Submission::reference("any").with("exam.json", GOOD);
    let path = submission.path().join("exam.json");
    let graded = submission.grade_with(&["--exam", path.to_str().unwrap()]);
    assert_eq!(graded.score()["points"], 5);
    assert_eq!(graded.score()["exam"]["id"], "small");
}

#[test]
fn one_can_come_through_standard_input() {
    let submission = Submission::reference("any");
    let mut grader = grader()
        .arg(submission.path())
        .args(["--exam", "-", "--out"])
        .arg(submission.path().join("out"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    grader
        .stdin
        .take()
        .unwrap()
        .write_all(GOOD.as_bytes())
        .unwrap();
    let output = grader.wait_with_output().unwrap();
    assert!(output.status.success());
    let report = String::from_utf8(output.stdout).unwrap();
    assert!(
        report.contains("small exam") && report.contains("5 / 5"),
        "{report}"
    );
}

#[test]
fn bad_ones_are_refused_with_place_and_remedy() {
    let cases = [
        ("empty", String::new()),
        ("cut off", GOOD[..200].to_owned()),
        (
            "tells of nothing",
            GOOD.replace(
                "\"look\"",
                r#""tells": {"elements": [9], "wrong": []}, "look""#,
            ),
        ),
        ("unknown key", GOOD.replace("\"look\"", "\"clue\"")),
        (
            "unknown task",
            GOOD.replace("\"task\": \"bbox\"", "\"task\": \"box\""),
        ),
        (
            "other version",
            GOOD.replace("\"schema\": 1", "\"schema\": 2"),
        ),
        (
            "no items",
            r#"{"schema": 1, "id": "none", "items": []}"#.to_owned(),
        ),
        (
            "negative points",
            GOOD.replace("\"points\": 5", "\"points\": -5"),
        ),
        (
            "id of another task",
            GOOD.replace("bbox.through", "sphere.through"),
        ),
        (
            "key of another kind",
            GOOD.replace(
                r#""spans": { "spans": [[2, 4], null] }"#,
                r#""tree": { "judged": [] }"#,
            ),
        ),
        (
            "shows too little",
            GOOD.replace(r#""key":"#, r#""shown": { "slabs": "AA" }, "key":"#),
        ),
        ("key too short", GOOD.replace("[[2, 4], null]", "[[2, 4]]")),
        (
            "needs what is not there",
            GOOD.replace("\"points\"", "\"needs\": [\"bbox.other\"], \"points\""),
        ),
    ];
    let refusals = cases.map(|(name, exam)| format!("{name}:\n  {}", refused(exam)));
    assert_snapshot!(refusals.join("\n"));
}

#[test]
fn bytes_that_are_no_text_are_refused() {
    assert!(refused(b"\xff\xfe").starts_with("error: the exam exam.json, "));
}

#[test]
fn an_exam_that_is_not_there_is_named() {
    let graded = Submission::reference("any").grade_with(&["--exam", "nowhere.json"]);
    assert_eq!(graded.exit_code(), 2);
    assert!(
        graded
            .error()
            .contains("can not read the exam nowhere.json"),
        "{}",
        graded.error()
    );
}
