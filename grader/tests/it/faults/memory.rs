//! A machine that runs out of memory. The tests send the signal that the kernel would send.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use super::assert_grader_fault;
use super::processes::{child_named, cpu_time, eventually};
use crate::harness::{Submission, grader};

/// The CPU time after which a process has certainly finished starting up.
const BUSY_CPU_TIME: Duration = Duration::from_millis(200);

/// Starts the grader on a submission, with `out` as the output folder.
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

/// Grades a submission. Meanwhile, kills the grader's child process called `name`, this many times.
fn grade_while_killing(name: &str, times: usize, submission: &Submission, out: &Path) -> Output {
    let grader = start(submission, out);
    let mut last = 0;
    for _ in 0..times {
        let busy = |child: &u32| *child != last && cpu_time(*child) > Some(BUSY_CPU_TIME);
        last = eventually(|| child_named(name, grader.id()).filter(busy));
        kill(last);
    }
    grader.wait_with_output().unwrap()
}

#[test]
fn a_compiler_killed_by_the_system_is_not_the_submissions_fault() {
    Submission::reference("first").grade();
    let submission = Submission::reference("long").with_replaced(
        "sphere.rs",
        "use framework::math;",
        "use framework::math;\n#[allow(long_running_const_eval)]\nconst LONG: u32 = {\nlet mut n = \
         0_u32;\nwhile n < 2 { n = (n + 1) % 2; }\nn\n};",
    );
    let out = submission.path().join("out");
    let output = grade_while_killing("rustc", 1, &submission, &out);
    assert_grader_fault(&output, &out, "give this machine more memory");
}

#[test]
fn a_probe_killed_twice_by_the_system_costs_no_points() {
    Submission::reference("first").grade();
    let submission = Submission::looping();
    let out = submission.path().join("out");
    let output = grade_while_killing("probe", 2, &submission, &out);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    assert!(error.contains("the system killed the program"), "{error}");
    let score = std::fs::read_to_string(out.join("score.json")).unwrap();
    assert!(score.contains("\"complete\": false"), "{score}");
}
