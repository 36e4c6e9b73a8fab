//! What is the machine's fault, or ours, is never a student's: there is a reason and exit code 3,
//! and no score; and of a run that ended too soon, nothing is taken for whole.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::harness::{Submission, grader};

fn is_our_fault(output: &Output, out: &Path, why: &str) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    assert!(error.contains(why), "{error}");
    assert!(!out.join("score.json").exists(), "there is a score");
}

#[test]
fn without_a_compiler_there_is_no_score() {
    let submission = Submission::reference("any");
    let out = submission.path().join("out");
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(&out);
    command.env_remove("CARGO").env("PATH", "/nonexistent");
    is_our_fault(&command.output().unwrap(), &out, "install Rust");
}

/// With a linker on the PATH that always fails.
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
    is_our_fault(
        &command.output().unwrap(),
        &out,
        "not even the files that were handed out",
    );
}

/// The device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn where_nothing_can_be_written_there_is_no_score() {
    let submission = Submission::reference("any");
    let out = Path::new("/dev/full/out");
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(out);
    command.arg("--no-reference");
    is_our_fault(&command.output().unwrap(), out, "can not write /dev/full");
}

/// A grader of the reference, into this folder.
fn start(submission: &Submission, out: &Path) -> Child {
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(out);
    command.args(["--no-reference"]);
    let command = command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

fn lasting(out: &Path) -> Option<Value> {
    let text = fs::read(out.join("score.json")).ok()?;
    let mut score: Value = serde_json::from_slice(&text).expect("a score is whole, or not there");
    score.as_object_mut().unwrap().remove("timings");
    Some(score)
}

/// Kills the grader at so many moments, spread over a run.
fn killed_at_any_moment(times: u32) {
    let submission = Submission::reference("killed");
    let out = submission.path().join("undisturbed");
    // Whatever is compiled once is compiled here.
    submission.grade();
    let began = Instant::now();
    start(&submission, &out).wait().unwrap();
    let took = began.elapsed();
    let undisturbed = lasting(&out).expect("a score");

    let mut partial = 0;
    for time in 0..times {
        // The fractions of multiples of the golden ratio leave no part of a run out.
        let moment = took.mul_f64(f64::from(time) * 0.618_034 % 1.0);
        let out = submission.path().join(format!("killed-{time}"));
        let mut grader = start(&submission, &out);
        thread::sleep(moment);
        grader.kill().unwrap();
        grader.wait().unwrap();
        if let Some(score) = lasting(&out) {
            assert!(
                score["complete"] == false || score == undisturbed,
                "at {moment:?}"
            );
            partial += u32::from(score["complete"] == false);
        }
        if time % 10 == 0 {
            start(&submission, &out).wait().unwrap();
            assert_eq!(lasting(&out).as_ref(), Some(&undisturbed), "at {moment:?}");
        }
    }
    eprintln!("killed {times} times in {took:?}, {partial} times with some points");
}

#[test]
fn of_a_run_that_was_killed_nothing_is_taken_for_whole() {
    killed_at_any_moment(6);
}

#[test]
#[ignore = "takes minutes: `cargo test -p grader --test it -- --ignored killed`"]
fn of_runs_killed_at_two_hundred_moments_nothing_is_taken_for_whole() {
    killed_at_any_moment(200);
}

/// A submission that hangs, whose grader is killed in the middle of it.
#[cfg(target_os = "linux")]
#[test]
fn no_process_outlives_a_grader_that_was_killed() {
    Submission::reference("first").grade();
    let submission = Submission::case("looping");
    let out = submission.path().join("out");
    let mut grader = start(&submission, &out);
    let probe = eventually(|| child_called("probe", grader.id()));
    grader.kill().unwrap();
    grader.wait().unwrap();
    eventually(|| (!is_running(probe)).then_some(()));
}

/// Waits for what is only a matter of time; other jobs may have the machine meanwhile.
fn eventually<T>(mut happened: impl FnMut() -> Option<T>) -> T {
    let deadline = Instant::now() + Duration::from_secs(60);
    loop {
        if let Some(what) = happened() {
            return what;
        }
        assert!(Instant::now() < deadline, "it never happened");
        thread::sleep(Duration::from_millis(5));
    }
}

/// Name, state and parent of a process.
fn stat(process: u32) -> Option<(String, String, u32)> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let (name, rest) = stat.rsplit_once(')')?;
    let mut words = rest.split_whitespace();
    let (state, parent) = (words.next()?.to_owned(), words.next()?.parse().ok()?);
    Some((name.split_once('(')?.1.to_owned(), state, parent))
}

fn child_called(name: &str, parent: u32) -> Option<u32> {
    let processes = fs::read_dir("/proc").unwrap().flatten();
    let mut numbers = processes.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    numbers.find(|number| {
        stat(*number).is_some_and(|(called, _, its)| called == name && its == parent)
    })
}

fn is_running(process: u32) -> bool {
    stat(process).is_some_and(|(_, state, _)| state != "Z")
}

/// Programs that keep every core busy. Ended when dropped.
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

/// Grades right and wrong work while every core is busy, over and over.
fn graded_under_load(times: usize) {
    let _load = Load::start();
    let points = || {
        let work = [
            Submission::reference("right"),
            Submission::case("panicking"),
        ];
        work.map(|submission| submission.grade().points())
    };
    let results: Vec<_> = (0..times).map(|_| points()).collect();
    assert_eq!(results[0][0].iter().sum::<u64>(), 100);
    assert!(
        results.iter().all(|points| *points == results[0]),
        "{results:?}"
    );
}

#[cfg(unix)]
#[test]
#[ignore = "takes minutes: `cargo test -p grader --test it -- --ignored load`"]
fn no_verdict_of_twenty_depends_on_load() {
    graded_under_load(20);
}
