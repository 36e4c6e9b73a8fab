//! Tests with a grader that is killed, and with a grader on a machine under load.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Instant;

use serde_json::Value;
#[cfg(target_os = "linux")]
use test_support::processes::{eventually, is_running};

use crate::cases::compile_dependencies;
use crate::harness::{Submission, grade_into};

#[cfg(target_os = "linux")]
use super::workspace::WorkspaceCopy;

/// Starts the grader on a submission, with `out` as the output folder.
fn start(submission: &Submission, out: &Path) -> Child {
    let mut command = grade_into(&submission.path(), out);
    command.args(["--no-reference", "--format", "gradescope", "junit"]);
    let command = command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

fn read_score(out: &Path) -> Option<Value> {
    let text = fs::read(out.join("score.json")).ok()?;
    let mut score: Value =
        serde_json::from_slice(&text).expect("a score file is complete, or missing");
    score.as_object_mut().unwrap().remove("timings");
    Some(score)
}

/// Panics if an output file for a platform is incomplete.
fn assert_outputs_parse(out: &Path) {
    if let Ok(text) = fs::read(out.join("gradescope.json")) {
        serde_json::from_slice::<Value>(&text).expect("a results file is complete, or missing");
    }
    if let Ok(text) = fs::read_to_string(out.join("junit.xml")) {
        roxmltree::Document::parse(&text).expect("a JUnit file is complete, or missing");
    }
}

/// Starts the grader this many times and kills each run at a different moment. The moments are
/// spread over the duration of a run.
fn kill_at_moments(times: u32) {
    let submission = Submission::reference("killed");
    let out = submission.path().join("undisturbed");
    // The timed run must not compile the dependencies.
    compile_dependencies();
    let began = Instant::now();
    start(&submission, &out).wait().unwrap();
    let took = began.elapsed();
    let undisturbed = read_score(&out).expect("a score");

    let mut partial = 0;
    for time in 0..times {
        // Multiples of the golden ratio, modulo 1, are evenly spread between 0 and 1.
        let moment = took.mul_f64(f64::from(time) * 0.618_034 % 1.0);
        let out = submission.path().join(format!("killed-{time}"));
        let mut grader = start(&submission, &out);
        thread::sleep(moment);
        grader.kill().unwrap();
        grader.wait().unwrap();
        assert_outputs_parse(&out);
        if let Some(score) = read_score(&out) {
            assert!(
                score["complete"] == false || score == undisturbed,
                "at {moment:?}"
            );
            partial += u32::from(score["complete"] == false);
        }
        if time % 10 == 0 {
            start(&submission, &out).wait().unwrap();
            let score = read_score(&out);
            assert_eq!(score.as_ref(), Some(&undisturbed), "at {moment:?}");
        }
    }
    eprintln!("killed {times} times in {took:?}, {partial} times with some points");
}

#[test]
fn a_killed_run_leaves_no_incomplete_file_that_looks_complete() {
    kill_at_moments(6);
}

#[test]
#[ignore = "takes minutes: `cargo test -p grader --test it -- --ignored killed`"]
fn two_hundred_killed_runs_leave_no_incomplete_file_that_looks_complete() {
    kill_at_moments(200);
}

/// Kills the grader while it waits for a fake cargo that has started another process and takes ten
/// minutes.
#[cfg(target_os = "linux")]
#[test]
fn cargo_does_not_outlive_a_killed_grader() {
    let workspace = WorkspaceCopy::new();
    let cargo = workspace.fake_cargo("sleep 600 &\necho $! > slept\nwait\n");
    let submission = Submission::reference("any");
    let mut command = submission.command();
    let command = command.env("CARGO", cargo).current_dir(workspace.path());
    let mut grader = command.stderr(Stdio::null()).spawn().unwrap();
    let slept = || fs::read_to_string(workspace.path().join("slept")).ok();
    let sleeping: u32 = eventually(|| slept()?.trim().parse().ok());
    assert!(is_running(sleeping));
    grader.kill().unwrap();
    grader.wait().unwrap();
    eventually(|| (!is_running(sleeping)).then_some(()));
}

/// Processes that keep every core busy until they are dropped.
struct Load(Vec<Child>);

impl Load {
    fn start() -> Self {
        let cores = thread::available_parallelism().map_or(2, usize::from);
        let busy = |_| {
            let mut busy = Command::new("sh");
            busy.args(["-c", "while :; do :; done"]).spawn().unwrap()
        };
        Load((0..2 * cores).map(busy).collect())
    }
}

impl Drop for Load {
    fn drop(&mut self) {
        for busy in &mut self.0 {
            busy.kill().ok();
            busy.wait().ok();
        }
    }
}

/// Grades correct and incorrect submissions repeatedly while every core is busy.
fn grade_under_load(times: usize) {
    let _load = Load::start();
    let points = || {
        let work = [Submission::reference("right"), Submission::panicking()];
        work.map(|submission| submission.grade().points())
    };
    let results: Vec<_> = (0..times).map(|_| points()).collect();
    assert_eq!(results[0][0].values().sum::<u64>(), 100);
    assert!(
        results.iter().all(|points| *points == results[0]),
        "{results:?}"
    );
}

#[cfg(unix)]
#[test]
#[ignore = "takes minutes: `cargo test -p grader --test it -- --ignored load`"]
fn twenty_runs_under_load_give_the_same_points() {
    grade_under_load(20);
}
