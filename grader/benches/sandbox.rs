//! What the sandbox costs: starting a probe until it answers, and compiling a submission, with and
//! without, turn by turn, so that a noisy machine disturbs both.
//!
//! `cargo bench -p grader --bench sandbox` prints medians and least values, at the best level that
//! holds here.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use grader::ask::Budget;
use grader::build::{Build, Builder};
use grader::isolate::best;
use grader::sandbox;
use grader::submission::Submission;
use grader::workspace::Workspace;
use protocol::Question;

const COMPILES: usize = 15;
const STARTS: usize = 100;
const BUDGET: Budget = Budget {
    cpu: Duration::from_secs(10),
};

fn main() -> ExitCode {
    // The sandbox starts this very program as its launcher.
    if let Some(ended) = sandbox::launched() {
        return ended;
    }
    let workspace = Workspace::find().expect("this is the workspace");
    let open = Builder::prepare(&workspace).expect("submissions can be built");
    let confined = match best(&open) {
        Ok(confined) => confined,
        Err(why) => {
            println!("{why}");
            return ExitCode::SUCCESS;
        }
    };
    let reference = root().join("reference/src");
    let submission = Submission::collect(&reference).expect("the reference is there");
    let builders = [&open, &confined];
    let builds = builders.map(|builder| builder.build(&submission).expect("it builds"));
    println!("{} beside none", builds[1].isolation());

    let compile = |which: usize| timed(|| drop(builders[which].build(&submission)));
    report("compile", COMPILES, compile);
    report("start of a probe", STARTS, |which| {
        timed(|| first_answer(&builds[which]))
    });
    ExitCode::SUCCESS
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn first_answer(build: &Build) {
    let program = build.probe.as_deref().expect("it compiles");
    let mut probe = build.launcher(program).start(BUDGET).expect("it starts");
    let nothing: [&Question; 0] = [];
    probe.ask(nothing, BUDGET).expect("it answers");
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    1e3 * start.elapsed().as_secs_f64()
}

/// In milliseconds.
fn report(what: &str, rounds: usize, one: impl Fn(usize) -> f64) {
    let rounds: Vec<[f64; 2]> = (0..rounds).map(|_| [one(0), one(1)]).collect();
    let sorted = |which: usize| {
        let mut values: Vec<f64> = rounds.iter().map(|round| round[which]).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let (open, confined) = (sorted(0), sorted(1));
    let middle = rounds.len() / 2;
    println!(
        "{what:20}least {:7.1} and {:7.1} ms, median {:7.1} and {:7.1} ms, {:.3} ×",
        open[0],
        confined[0],
        open[middle],
        confined[middle],
        confined[middle] / open[middle],
    );
}
