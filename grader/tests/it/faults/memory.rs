//! A machine that runs out of memory: the system ends what it likes, by the signal that we send here.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use super::is_our_fault;
use super::processes::{child_called, cpu_time, eventually};
use crate::harness::{Submission, grader};

/// Who has computed for so long is at work on what it was started for.
const A_WHILE: Duration = Duration::from_millis(200);

/// A grader of the submission, into the folder `out` beside its files.
fn start(submission: &Submission, out: &Path) -> Child {
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(out);
    command.args(["--no-reference", "--cpu-limit", "600"]);
    let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn kill(process: u32) {
    let kill = format!("kill -KILL {process}");
    let status = Command::new("sh").args(["-c", &kill]).status();
    assert!(status.unwrap().success());
}

/// What becomes of a grader whose child of this name is killed so many times.
fn when_killed(name: &str, times: usize, submission: &Submission, out: &Path) -> Output {
    let grader = start(submission, out);
    let mut last = 0;
    for _ in 0..times {
        let busy = |child: &u32| *child != last && cpu_time(*child) > Some(A_WHILE);
        last = eventually(|| child_called(name, grader.id()).filter(busy));
        kill(last);
    }
    grader.wait_with_output().unwrap()
}

#[test]
fn a_compiler_that_the_system_ends_is_no_fault_of_what_it_compiled() {
    Submission::reference("first").grade();
    let submission = Submission::reference("long").changed(
        "sphere.rs",
        "use framework::math;",
        "use framework::math;\n#[allow(long_running_const_eval)]\nconst LONG: u32 = {\nlet mut n = \
         0_u32;\nwhile n < 2 { n = (n + 1) % 2; }\nn\n};",
    );
    let out = submission.path().join("out");
    let output = when_killed("rustc", 1, &submission, &out);
    is_our_fault(&output, &out, "give this machine more memory");
}

#[test]
fn a_program_that_the_system_ends_twice_costs_no_points() {
    Submission::reference("first").grade();
    let submission = Submission::case("looping");
    let out = submission.path().join("out");
    let output = when_killed("probe", 2, &submission, &out);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    assert!(
        error.contains("the system has ended the program"),
        "{error}"
    );
    let score = std::fs::read_to_string(out.join("score.json")).unwrap();
    assert!(score.contains("\"complete\": false"), "{score}");
}
