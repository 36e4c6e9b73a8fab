//! Six submissions, each graded once: the output in every format is checked against the model of
//! its platform. Snapshots of one of them show the formats end to end.

use insta::assert_snapshot;

use crate::formats::{
    FormatTexts, grade_in_all_formats, hostile_submission, models, small_exam, student_formats,
};
use crate::harness::Submission;

/// Grades a submission, checks each output against the model of its platform, and returns all
/// outputs.
fn assert_valid(submission: &Submission, arguments: &[&str]) -> FormatTexts {
    let written = grade_in_all_formats(submission, &small_exam("practice"), arguments);
    for format in student_formats() {
        models::check(format.id, &written[format.id]);
    }
    written
}

fn snapshot_settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.add_filter(r#""execution_time": [0-9.]+"#, r#""execution_time": 1.5"#);
    settings.add_filter(r#""isolation": "[a-z-]+""#, r#""isolation": "as reached""#);
    settings
}

/// Returns the lines of a log that the runner executes.
fn runner_commands(log: &str) -> String {
    let lines = log.lines();
    let commands: Vec<&str> = lines.filter(|line| line.starts_with("::")).collect();
    commands.join("\n")
}

#[test]
fn every_submission_is_rendered_in_valid_formats() {
    let written = assert_valid(&Submission::reference("perfect"), &[]);
    assert_eq!(runner_commands(&written["log"]), "");
    assert_valid(&Submission::starter("starter"), &[]);
    assert_valid(&Submission::not_compiling(), &[]);
    assert_valid(&Submission::looping(), &["--cpu-limit", "1"]);
}

#[test]
fn renders_a_known_mistake() {
    let written = assert_valid(&Submission::far_first("partial"), &[]);
    snapshot_settings().bind(|| {
        // The snapshots of a sample show each format; this shows what a real submission adds to it.
        assert_snapshot!(
            "junit-partial",
            models::readable("junit", &written["junit"])
        );
        assert_snapshot!("annotations-partial", runner_commands(&written["log"]));
    });
}

#[test]
fn hostile_text_is_rendered_without_commands_for_the_runner() {
    let written = assert_valid(&hostile_submission(), &[]);
    snapshot_settings().bind(|| {
        assert_snapshot!("annotations-forging", runner_commands(&written["log"]));
    });
}
