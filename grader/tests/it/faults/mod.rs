//! Faults of the machine or of the grader, which never cost a student points: the grader prints the
//! reason, exits with 3, and writes no score. A run that was cut short leaves no file that looks
//! complete.

#[cfg(target_os = "linux")]
mod disk;
mod kills;
#[cfg(target_os = "linux")]
mod memory;
#[cfg(target_os = "linux")]
pub mod processes;
#[cfg(target_os = "linux")]
pub mod workspace;

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::harness::{Submission, grader};

fn assert_grader_fault(output: &Output, out: &Path, why: &str) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    assert!(error.contains(why), "{error}");
    assert!(!out.join("score.json").exists(), "a score was written");
}

#[test]
fn without_a_compiler_there_is_no_score() {
    let submission = Submission::reference("any");
    let out = submission.path().join("out");
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(&out);
    command.env_remove("CARGO").env("PATH", "/nonexistent");
    assert_grader_fault(&command.output().unwrap(), &out, "install Rust");
}

/// Grades with a linker on the `PATH` that always fails.
#[cfg(unix)]
#[test]
fn without_a_linker_there_is_no_score() {
    use std::os::unix::fs::PermissionsExt;

    let submission = Submission::reference("any");
    let tools = submission.path().join("tools");
    fs::create_dir(&tools).unwrap();
    let linker = tools.join("cc");
    fs::write(
        &linker,
        "#!/bin/sh\necho No space left on device >&2\nexit 1\n",
    )
    .unwrap();
    fs::set_permissions(&linker, fs::Permissions::from_mode(0o755)).unwrap();

    let out = submission.path().join("out");
    let path = format!("{}:{}", tools.display(), std::env::var("PATH").unwrap());
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(&out);
    command.arg("--no-reference").env("PATH", path);
    assert_grader_fault(
        &command.output().unwrap(),
        &out,
        "not even the starter compiles",
    );
}

/// Grades into `/dev/full`, the device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn without_a_writable_disk_there_is_no_score() {
    let submission = Submission::reference("any");
    let out = Path::new("/dev/full/out");
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(out);
    command.arg("--no-reference");
    assert_grader_fault(&command.output().unwrap(), out, "cannot write /dev/full");
}
