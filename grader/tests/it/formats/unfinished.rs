//! Jobs that were killed, and formats that are requested on the wrong platform.

use grader::exam_source::ExamSource;
use grader::format::{FORMATS, FormatContext, StudentView};
use grader::handed_out::RAYS;
use grader::policy::{Lateness, Policy};
use grader::score::Verdict;
use grader::verdict::pending_score;

use crate::formats::models::{check, readable};
use crate::harness::{Submission, grader};

#[test]
fn a_killed_job_says_that_it_is_unfinished() {
    let file = ExamSource::Practice.load(&RAYS).unwrap();
    let mut around = FormatContext::default();
    for name in FORMATS.iter().flat_map(|format| format.variables) {
        around.variables.insert(name, "submit/x".to_owned());
    }
    around
        .variables
        .insert("ASSIGNMENT_TYPE", "individual".to_owned());
    around
        .variables
        .insert("SUBMITTED_AT", "2026-11-20T21:09:58Z".to_owned());
    let score = pending_score(&file.exam, file.name(), "killed", &RAYS);
    let seen = StudentView::new(&score, &Policy::default(), Lateness::NONE);
    let unfinished = format!("UNFINISHED: 0 of {}", file.exam.items.len());
    for format in FORMATS {
        let Some(render) = format.render else {
            continue;
        };
        let text = render(&seen, &around);
        check(format.id, &text);
        let text = readable(format.id, &text);
        let marks = [unfinished.as_str(), Verdict::Pending.label()];
        assert!(
            marks.iter().any(|mark| text.contains(mark)),
            "{}: {text}",
            format.id
        );
    }
}

#[test]
fn a_format_names_a_missing_runner_variable() {
    let submission = Submission::starter("starter");
    let output = grader()
        .arg(submission.path())
        .args(["--no-reference", "--format", "classroom50"])
        .env_remove("CLASSROOM")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("CLASSROOM, which is not set"), "{error}");
}

#[test]
fn an_unknown_format_lists_the_known_ones() {
    let output = grader().args(["--format", "gradescop"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8(output.stderr).unwrap();
    let known = FORMATS.map(|format| format.id).join(", ");
    assert!(error.contains(&known), "{error}");
}
