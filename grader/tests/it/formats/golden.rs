//! Six submissions, each graded once. The output in every format is checked against the model of
//! its platform. Snapshots of one submission's outputs show the formats end to end.

use insta::assert_snapshot;

use crate::formats::{
    FormatTexts, KNOWN_MISTAKE, grade_in_all_formats, hostile_submission, models, small_exam,
    student_formats,
};
use crate::harness::Submission;

/// Checks each output against the model of its platform.
fn assert_valid(written: &FormatTexts) {
    for format in student_formats() {
        models::check(format.id, &written[format.id]);
    }
}

/// Grades a submission, checks the outputs and returns them.
fn valid_outputs(submission: &Submission, arguments: &[String]) -> FormatTexts {
    let written = grade_in_all_formats(submission, &small_exam("practice"), arguments);
    assert_valid(&written);
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
    let written = valid_outputs(&Submission::reference("perfect"), &[]);
    assert_eq!(runner_commands(&written["log"]), "");
    valid_outputs(&Submission::starter("starter"), &[]);
    valid_outputs(&Submission::not_compiling(), &[]);
    let limit = ["--cpu-limit", "1"].map(str::to_owned);
    valid_outputs(&Submission::looping(), &limit);
}

#[test]
fn renders_a_known_mistake() {
    let written = &*KNOWN_MISTAKE;
    assert_valid(written);
    snapshot_settings().bind(|| {
        // Other snapshots show a sample in each format. These snapshots show what a real submission
        // adds.
        assert_snapshot!(
            "junit-partial",
            models::readable("junit", &written["junit"])
        );
        assert_snapshot!("annotations-partial", runner_commands(&written["log"]));
    });
}

#[test]
fn hostile_text_is_rendered_without_commands_for_the_runner() {
    let written = valid_outputs(&hostile_submission(), &[]);
    snapshot_settings().bind(|| {
        assert_snapshot!("annotations-forging", runner_commands(&written["log"]));
    });
}
