//! Secrets that formats must not show to students: notes for staff, and the questions and answers
//! of a final exam.

use std::fs;

use serde_json::Value;

use crate::formats::{
    FormatTexts, KNOWN_MISTAKE, grade_in_all_formats, hostile_submission, models, small_exam,
    student_formats,
};
use crate::harness::Submission;

/// Returns all text that students can read: every format, and everything printed.
fn student_text(written: &FormatTexts) -> String {
    let formats = student_formats().map(|format| models::readable(format.id, &written[format.id]));
    let printed = ["log", "errors"].map(|stream| written[stream].clone());
    formats.chain(printed).collect()
}

/// Returns the parts of the score file that only staff may read.
fn secrets(written: &FormatTexts) -> Vec<String> {
    let score: Value = serde_json::from_str(&written["json"]).unwrap();
    let mut secrets = vec![score["exam"]["hash"].as_str().unwrap().to_owned()];
    for task in score["tasks"].as_array().unwrap() {
        for item in task["items"].as_array().unwrap() {
            let evidence = &item["evidence"];
            let texts = [&item["staff"], &evidence["asked"], &evidence["wanted"]];
            let texts = texts.into_iter().filter_map(Value::as_str);
            // Short texts, such as `none`, occur everywhere.
            secrets.extend(texts.filter(|text| text.len() > 12).map(str::to_owned));
        }
    }
    secrets
}

#[test]
fn no_format_reveals_a_final_exams_questions_and_answers() {
    for submission in [Submission::far_first("far"), hostile_submission()] {
        let written = grade_in_all_formats(&submission, &small_exam("final"), &[]);
        let (read, secrets) = (student_text(&written), secrets(&written));
        assert!(secrets.len() > 2, "there are secrets to look for");
        for secret in secrets {
            assert!(!read.contains(&secret), "a format reveals {secret:?}");
        }
        let has_question = read.contains("Vec3(");
        assert!(!has_question, "the message of a panic repeats the question");
    }
}

#[test]
fn the_search_finds_revealed_text() {
    let read = student_text(&KNOWN_MISTAKE);
    let secrets = secrets(&KNOWN_MISTAKE);
    let revealed = secrets.iter().filter(|secret| read.contains(*secret));
    let count = revealed.count();
    assert!(count >= 1, "questions of the practice exam are shown");
    let staff = secrets.iter();
    let staff = staff.filter(|secret| secret.starts_with("the answers match"));
    let staff: Vec<&String> = staff.collect();
    assert!(!staff.is_empty() && staff.iter().all(|note| !read.contains(*note)));
}

#[test]
fn hidden_items_are_left_out_or_summed_up() {
    let far = Submission::far_first("far");
    let policy = "[visibility.items]
        sphere = 'after_due'
        camera = 'points'
        'camera.corners' = 'hidden'";
    let policy = far.file_option("--policy", "policy.toml", policy);
    let exam = small_exam("practice");
    let written = grade_in_all_formats(&far, &exam, &policy);
    let gradescope: Value = serde_json::from_str(&written["gradescope"]).unwrap();
    let tests = gradescope["tests"].as_array().unwrap().iter();
    let shown = tests.map(|test| test["visibility"].as_str().unwrap());
    let shown: Vec<&str> = shown.collect();
    let exam: Value = serde_json::from_str(&exam).unwrap();
    let items = exam["items"].as_array().unwrap().iter();
    let expected = items.map(|item| match item["id"].as_str().unwrap() {
        "camera.corners" => "hidden",
        id if id.starts_with("sphere.") => "after_due_date",
        _ => "visible",
    });
    assert_eq!(shown, expected.collect::<Vec<&str>>());
    // If a platform cannot reveal items later, it only gets the sum of their points.
    let others = student_formats().filter(|format| format.id != "gradescope");
    for format in others.map(|format| format.id) {
        let text = models::readable(format, &written[format]);
        assert!(!text.contains("sphere.near_side"), "{format}: {text}");
        let title = "a ray from outside hits the near side";
        assert!(!text.contains(title), "{format}: {text}");
    }
    assert!(written["classroom50"].contains("2 items that are not shown"));
    models::check("classroom50", &written["classroom50"]);
}

#[test]
fn annotations_are_on_the_students_own_lines() {
    let submission = Submission::far_first("same");
    let text = fs::read_to_string(submission.path().join("sphere.rs")).unwrap();
    let mut lines = text.lines();
    let line = 1 + lines.position(|line| line.contains("pub fn hit(")).unwrap();
    let head = format!("::error file=partial/sphere.rs,line={line},title=Task 2%3A spheres");
    let log = &KNOWN_MISTAKE["log"];
    assert!(log.contains(&head), "{log}");
}
