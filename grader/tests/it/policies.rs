//! Course policies: how final points are computed, and how mistakes in a policy file are reported.

use serde_json::Value;

use crate::formats::{FormatTexts, grade_in_all_formats, models, small_exam, student_formats};
use crate::harness::{Submission, assert_fails, grader};

#[test]
fn an_invalid_policy_is_rejected_before_anything_is_graded() {
    let submission = Submission::starter("any");
    let policy = submission.file_option("--policy", "policy.toml", "[late]\nfree_dayz = 2");
    let graded = submission.grade_with(&policy);
    let line = "policy.toml, line 2: unknown field `free_dayz`";
    assert_fails(&graded.output, 2, line);
    assert!(graded.score.is_none(), "nothing was graded");
}

#[test]
fn the_policy_scales_points_but_not_the_score() {
    let submission = Submission::not_compiling();
    let policy = submission.file_option("--policy", "policy.toml", "[points]\nout_of = 30");
    let graded = submission.grade_with(&policy);
    let points = graded.score()["points"].as_u64().unwrap();
    let counted = (2 * points * 30 + 100) / 200;
    let line =
        format!("{counted} of 30 points count towards the grade: {points} of 100 points earned.");
    assert!(graded.report().contains(&line), "{}", graded.report());
    assert!(graded.page().contains(&line), "the page says the same");
}

#[test]
fn the_default_policy_explains_itself() {
    let output = grader().arg("--policy-default").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text, grader::policy::DEFAULT);
}

#[test]
fn every_format_says_what_a_late_submission_counts_and_why() {
    let written = grade_late("[points]\nout_of = 50\n[late]\npercent_per_day = 10");
    let results: Value = serde_json::from_str(&written["gradescope"]).unwrap();
    let points = results["extra_data"]["points"].as_u64().unwrap();
    assert_eq!(results["score"], 45);
    let line = format!(
        "45 of 50 points count towards the grade: {points} of {points} points earned, handed in 1 \
         day late, so 10% of the points earned are deducted."
    );
    for format in student_formats() {
        let text = models::readable(format.id, &written[format.id]);
        assert!(text.contains(&line), "{}: {text}", format.id);
    }
    assert!(written["log"].contains(&line), "{}", written["log"]);
}

/// Grades the reference with a policy, as if it had been submitted ten minutes after Gradescope's
/// due time.
fn grade_late(policy: &str) -> FormatTexts {
    let metadata = r#"{"id": 1, "created_at": "2026-11-21T00:10:00.365935-08:00",
        "assignment": {"due_date": "2026-11-20T23:59:59.000000-08:00", "late_due_date": null}}"#;
    let submission = Submission::reference("late");
    let policy = submission.file_option("--policy", "policy.toml", policy);
    let metadata = submission.file_option("--gradescope-metadata", "metadata.json", metadata);
    let late = [policy, metadata].concat();
    grade_in_all_formats(&submission, &small_exam("final"), &late)
}

#[test]
fn missing_submission_times_are_not_the_students_fault() {
    let submission = Submission::starter("any");
    let metadata = submission.file_option("--gradescope-metadata", "metadata.json", "{}");
    let graded = submission.grade_with(&metadata);
    assert_fails(&graded.output, 3, "so that no submission counts as late");
}
