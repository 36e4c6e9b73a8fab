//! Faults in the machine or in the grader, which never cost a student points. The grader prints the
//! reason, exits with 3 and writes no score. An interrupted run never leaves a file that looks
//! complete.

#[cfg(target_os = "linux")]
mod disk;
mod kills;
#[cfg(target_os = "linux")]
mod memory;
#[cfg(target_os = "linux")]
pub mod workspace;

use std::path::Path;

#[cfg(unix)]
use test_support::programs::{path_with, write_program};

use crate::harness::{GradeRun, Submission, assert_fails, grade_into};

#[track_caller]
fn assert_grader_fault(graded: &GradeRun, why: &str) {
    assert_fails(&graded.output, 3, why);
    assert!(graded.score.is_none(), "a score was written");
}

#[test]
fn without_a_compiler_there_is_no_score() {
    let submission = Submission::reference("any");
    let mut command = submission.command();
    command.env_remove("CARGO").env("PATH", "/nonexistent");
    assert_grader_fault(&submission.run(&mut command), "install Rust");
}

/// Grades with a linker on the `PATH` that always fails.
#[cfg(unix)]
#[test]
fn without_a_linker_there_is_no_score() {
    let submission = Submission::reference("any");
    let tools = submission.path().join("tools");
    write_program(
        &tools.join("cc"),
        "echo No space left on device >&2\nexit 1\n",
    );
    let graded = submission.run(submission.command().env("PATH", path_with(&tools)));
    assert_grader_fault(&graded, "even the unmodified starter code fails to compile");
}

/// Grades with the output going to `/dev/full`, a device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn without_a_writable_disk_there_is_no_score() {
    let submission = Submission::reference("any");
    let mut command = grade_into(&submission.path(), Path::new("/dev/full/out"));
    let graded = submission.run(command.arg("--no-reference"));
    assert_grader_fault(&graded, "cannot write /dev/full");
}
