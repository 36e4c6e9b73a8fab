//! Snapshots of each format for six submissions. Each submission is graded once, and each output is
//! also checked against the model of its platform.

use insta::assert_snapshot;

use crate::formats::{
    grade_in_all_formats, hostile_submission, models, small_exam, student_formats,
};
use crate::harness::Submission;

fn assert_snapshots(case: &str, submission: &Submission, arguments: &[&str]) {
    let written = grade_in_all_formats(submission, &small_exam("practice"), arguments);
    for format in student_formats() {
        models::check(format.id, &written[format.id]);
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.add_filter(r#""execution_time": [0-9.]+"#, r#""execution_time": 1.5"#);
    settings.add_filter(r#""isolation": "[a-z-]+""#, r#""isolation": "as reached""#);
    settings.bind(|| {
        // Other tests check the contents of the page; here it is only checked against its model.
        for format in student_formats().map(|format| format.id) {
            if format == "html" {
                continue;
            }
            let text = models::readable(format, &written[format]);
            assert_snapshot!(format!("{format}-{case}"), text);
        }
        assert_snapshot!(
            format!("annotations-{case}"),
            runner_commands(&written["log"])
        );
    });
}

/// Returns the lines of a log that the runner executes.
fn runner_commands(log: &str) -> String {
    let lines = log.lines();
    let commands: Vec<&str> = lines.filter(|line| line.starts_with("::")).collect();
    commands.join("\n")
}

#[test]
fn renders_a_perfect_submission() {
    assert_snapshots("perfect", &Submission::reference("perfect"), &[]);
}

#[test]
fn renders_the_starter() {
    assert_snapshots("starter", &Submission::starter("starter"), &[]);
}

#[test]
fn renders_a_known_mistake() {
    let partial = Submission::reference("partial");
    let partial = partial.with_replaced("sphere.rs", "[near, far]", "[far, near]");
    assert_snapshots("partial", &partial, &[]);
}

#[test]
fn renders_a_file_that_does_not_compile() {
    assert_snapshots("not-compiling", &Submission::not_compiling(), &[]);
}

#[test]
fn renders_an_endless_loop() {
    assert_snapshots("hanging", &Submission::looping(), &["--cpu-limit", "1"]);
}

#[test]
fn renders_hostile_text_harmlessly() {
    assert_snapshots("forging", &hostile_submission(), &[]);
}
