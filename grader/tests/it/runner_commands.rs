//! A CI system executes commands found in a log. Nothing a student chooses may become such a
//! command.

use std::io::{Cursor, Write};
use std::process::{Command, Output};

use grader::printing::without_commands;
use test_support::WatchProcess;
use zip::ZipWriter;

use crate::harness::{Submission, grader, workspace};

/// One command of each kind, written so that the text is also a valid file name.
const COMMANDS: &str = "::error::a ##[set-env name=a]b ##vso[task.complete]c ##teamcity[d]";

/// Returns a program's output on a CI system. Panics if the commands are missing, or if one of them
/// is printed in such a way that the system would run it. A line may begin with `own`, a command
/// that the grader itself prints.
fn checked_output(command: &mut Command, own: &str) -> String {
    let Output { stdout, stderr, .. } = command.env("GITHUB_ACTIONS", "true").output().unwrap();
    let text = [stdout, stderr].map(|text| String::from_utf8(text).unwrap());
    let text = text.join("\n");
    for line in text.split(['\n', '\r']) {
        let others = line.strip_prefix(own).unwrap_or(line);
        assert_eq!(without_commands(others), others, "{command:?}: {text}");
    }
    assert!(text.contains("set-env"), "{command:?}: {text}");
    text
}

/// Returns a submission with commands in every place where a submission can contain them.
fn hostile_submission() -> Submission {
    let printed = format!("\\n{COMMANDS}\\n  {COMMANDS}\\r{COMMANDS}\\u{{1b}}[1m{COMMANDS}");
    let head = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let attack = format!("{head} println!(\"{printed}\"); panic!(\"{printed}\");");
    Submission::reference(COMMANDS)
        .with_replaced("sphere.rs", head, &attack)
        .with("camera.rs", format!("compile_error!(\"{COMMANDS}\");"))
        .with(&format!("{COMMANDS}.rs"), "")
}

#[test]
fn nothing_of_a_submission_is_a_command_in_a_log() {
    let submission = hostile_submission();
    let folder = submission.path().parent().unwrap().to_owned();
    let run = |arguments: &[&str], own| {
        let mut command = grader();
        command.current_dir(&folder).arg(COMMANDS);
        command.args(["--no-reference", "--isolation", "none"]);
        checked_output(command.args(arguments), own)
    };
    let log = run(&["--format", "github", "--out", "out"], "::error ");
    let annotations = log.lines().filter(|line| line.starts_with("::error "));
    assert!(annotations.count() >= 2, "{log}");
    // Print the cached report.
    run(&["--out", "graded"], "");
    run(&["--out", "graded"], "");
    run(&["--replay", "sphere.from_inside#1"], "");

    let mut handin = Command::new(env!("CARGO_BIN_EXE_handin"));
    handin.current_dir(workspace()).arg(submission.path());
    checked_output(handin.arg("--out").arg(folder.join("a.zip")), "");

    let report = WatchProcess::start(&mut submission.command()).report();
    assert_eq!(without_commands(&report), report);
    assert!(report.contains("set-env"), "{report}");
}

#[test]
fn no_name_in_an_error_is_a_command_in_a_log() {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    let member = format!("../{COMMANDS}");
    archive.start_file(member, options).unwrap();
    archive.write_all(b"x").unwrap();
    let submission = Submission::reference("alice")
        .with("a.zip", archive.finish().unwrap().into_inner())
        .with("policy.toml", format!("{COMMANDS:?} = 1"))
        .with("exam.json", format!("{{{COMMANDS:?}: 1}}"));
    for arguments in [
        &["a.zip"][..],
        &[COMMANDS],
        &[".", "--policy", "policy.toml"],
        &[".", "--policy", COMMANDS],
        &[".", "--exam", "exam.json"],
        &[".", "--exam", COMMANDS],
        &[".", "--task", COMMANDS],
        &[".", "--replay", COMMANDS],
        &[".", "--format", COMMANDS],
        &[".", "--watch", COMMANDS],
        &["--reset", COMMANDS],
    ] {
        let mut command = grader();
        let command = command.current_dir(submission.path());
        checked_output(command.args(arguments), "");
    }
}
