//! Measures the cost of the sandbox by starting a probe (up to its first answer) and compiling a
//! submission, each with and without the sandbox. Runs with and without it alternate, so that a
//! busy machine affects both.
//!
//! `cargo bench -p grader --bench sandbox` prints CPU time and wall time at the best available
//! isolation level.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use bench_support::{Cost, median, repetitions};
use grader::build::{Build, Builder};
use grader::handed_out::RAYS;
use grader::probe::ItemLimits;
use grader::sandbox;
use grader::select_isolation::with_best_level;
use grader::submission::Submission;
use grader::workspace::Workspace;
use protocol::Question;

const COMPILES: usize = 15;
const STARTS: usize = 100;
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(10));

fn main() -> ExitCode {
    // The sandbox starts this program again as its launcher.
    if let Some(ended) = sandbox::run_as_launcher() {
        return ended;
    }
    let workspace = Workspace::find().expect("the benchmark runs in the workspace");
    let open = Builder::prepare(&workspace).expect("the dependencies can be built");
    let confined = match with_best_level(&open) {
        Ok(confined) => confined,
        Err(why) => {
            println!("{why}");
            return ExitCode::SUCCESS;
        }
    };
    let reference = root().join("reference/src");
    let submission = Submission::collect(&reference, &RAYS).expect("the reference can be read");
    let builders = [&open, &confined];
    let builds = builders.map(|builder| {
        builder
            .build(&submission)
            .expect("the reference can be built")
    });
    println!(
        "isolation level {} compared with none",
        builds[1].isolation()
    );

    let compile = |index: usize| Cost::of(|| drop(builders[index].build(&submission)));
    report("compile", COMPILES, compile);
    report("start a probe", STARTS, |index| {
        Cost::of(|| first_answer(&builds[index]))
    });
    ExitCode::SUCCESS
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn first_answer(build: &Build) {
    let program = build.probe.as_deref().expect("the reference compiles");
    let mut probe = build
        .launcher(program)
        .start(LIMITS.cpu)
        .expect("the probe starts");
    let nothing: [&Question; 0] = [];
    probe.ask(nothing, LIMITS).expect("the probe answers");
}

/// Measures `one` without the sandbox (index 0) and with it (index 1), `rounds` times each, or once
/// in the short form. Prints the median CPU and wall times in milliseconds and their ratio.
fn report(what: &str, rounds: usize, one: impl Fn(usize) -> Cost) {
    let rounds: Vec<[Cost; 2]> = (0..repetitions(rounds)).map(|_| [one(0), one(1)]).collect();
    let print = |name: &str, time: fn(&Cost) -> Duration| {
        let [open, confined] = [0, 1].map(|index| {
            let times = rounds.iter().map(|round| time(&round[index]));
            1e3 * median(times.map(|time| time.as_secs_f64()))
        });
        let ratio = confined / open;
        println!("{what:18}{name:14}{open:8.1} and {confined:8.1} ms, {ratio:.3} ×");
    };
    print("CPU", |cost| cost.cpu);
    print("wall", |cost| cost.wall);
}
