//! Invalid exams are rejected before grading starts, with the position of the error and advice.

use std::io::Write;
use std::process::Stdio;

use grader::handed_out::RAYS;
use insta::assert_snapshot;

use crate::harness::{Submission, assert_fails};

/// A valid exam with one item.
const VALID_EXAM: &str = r#"{
  "schema": 3, "assignment": "rays",
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
          "question": { "bbox_hit": {
            "subject": { "min": [-1, -1, -1], "max": [1, 1, 1] },
            "rows": { "list": [
              { "ray": { "origin": [-3, 0, 0], "dir": [1, 0, 0], "range": [0, null] }, "times": [0, null] },
              { "ray": { "origin": [-3, 0, 0], "dir": [-1, 0, 0], "range": [0, null] }, "times": [0, null] }
            ] }
          } },
          "key": { "table": {
            "judged": ["interval inside the box"],
            "rows": { "spans": [[2, 4], null] }
          } }
        }
      ]
    }
  ]
}"#;

fn rejection(exam: impl AsRef<[u8]>) -> String {
    let submission = Submission::reference("any");
    let exam = submission.file_option("--exam", "exam.json", exam);
    let graded = submission.grade_with(&exam);
    assert_eq!(graded.exit_code(), 2, "{}", graded.error());
    assert!(graded.score.is_none(), "nothing was graded");
    let error = graded.error().replace(&exam[1], "exam.json");
    error.replace(&RAYS.assignment.id_list(), "TASKS")
}

#[test]
fn reads_an_exam_from_standard_input() {
    let submission = Submission::reference("any");
    let mut command = submission.command();
    command.args(["--exam", "-"]).stdin(Stdio::piped());
    let mut grader = command.stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = grader.stdin.take().unwrap();
    stdin.write_all(VALID_EXAM.as_bytes()).unwrap();
    drop(stdin);
    let graded = submission.results(grader.wait_with_output().unwrap());
    assert_eq!(graded.exit_code(), 0);
    let report = graded.report();
    for text in ["small exam", "5 / 5"] {
        assert!(report.contains(text), "{report}");
    }
}

#[test]
fn rejects_invalid_exams_with_position_and_remedy() {
    let with = |from: &str, to: &str| VALID_EXAM.replace(from, to);
    let none = r#"{"schema": 3, "assignment": "rays", "id": "none", "items": []}"#;
    let signatures = r#""signatures": {"elements": [9], "mistake_answers": []}, "look""#;
    let spans = r#""rows": { "spans": [[2, 4], null] }"#;
    let slabs = r#""drawing_data": { "slabs": "AA" }, "key":"#;
    let needs = r#""needs": ["bbox.other"], "points""#;
    let cases = [
        ("empty", String::new()),
        ("truncated", VALID_EXAM[..200].to_owned()),
        (
            "signatures of unknown elements",
            with("\"look\"", signatures),
        ),
        ("unknown key", with("\"look\"", "\"clue\"")),
        (
            "unknown task",
            with(r#""task": "bbox""#, r#""task": "box""#),
        ),
        ("other version", with(r#""schema": 3"#, r#""schema": 4"#)),
        ("no items", none.to_owned()),
        ("negative points", with(r#""points": 5"#, r#""points": -5"#)),
        ("id of another task", with("bbox.through", "sphere.through")),
        (
            "key of another kind",
            with(spans, r#""rows": { "rays": [[1, 0, 0], [0, 1, 0]] }"#),
        ),
        ("too little drawing data", with(r#""key":"#, slabs)),
        ("key too short", with("[[2, 4], null]", "[[2, 4]]")),
        (
            "unknown quantity",
            with("interval inside the box", "distance"),
        ),
        ("needs an unknown item", with("\"points\"", needs)),
    ];
    let rejections = cases.map(|(name, exam)| format!("{name}:\n  {}", rejection(exam)));
    assert_snapshot!(rejections.join("\n"));
}

#[test]
fn rejects_exams_that_are_not_utf8() {
    assert!(rejection(b"\xff\xfe").starts_with("error: the exam exam.json is not valid: "));
}

#[test]
fn names_a_missing_exam_file() {
    let graded = Submission::reference("any").grade_with(&["--exam", "nowhere.json"]);
    assert_fails(&graded.output, 2, "cannot read the exam nowhere.json");
}
