//! What the sandbox costs: starting a probe until it answers, and compiling a submission, with and
//! without, turn by turn, so that a noisy machine disturbs both.
//!
//! `cargo bench -p grader --bench sandbox` prints CPU time, and time by the clock, at the best level
//! that holds here.

#[path = "warm_grade/cost.rs"]
#[allow(
    dead_code,
    reason = "no program is measured here, but what the grader does"
)]
mod cost;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use grader::build::{Build, Builder};
use grader::probe::Budget;
use grader::sandbox;
use grader::select_isolation::with_best_level;
use grader::submission::Submission;
use grader::workspace::Workspace;
use protocol::Question;

use cost::Cost;

const COMPILES: usize = 15;
const STARTS: usize = 100;
const BUDGET: Budget = Budget {
    cpu: Duration::from_secs(10),
};

fn main() -> ExitCode {
    // The sandbox starts this very program as its launcher.
    if let Some(ended) = sandbox::run_as_launcher() {
        return ended;
    }
    let workspace = Workspace::find().expect("this is the workspace");
    let open = Builder::prepare(&workspace).expect("submissions can be built");
    let confined = match with_best_level(&open) {
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

    let compile = |which: usize| Cost::of(|| drop(builders[which].build(&submission)));
    report("compile", COMPILES, compile);
    report("start of a probe", STARTS, |which| {
        Cost::of(|| first_answer(&builds[which]))
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

/// Medians, in milliseconds, without and with; and how many times as much that is.
fn report(what: &str, rounds: usize, one: impl Fn(usize) -> Cost) {
    let rounds: Vec<[Cost; 2]> = (0..rounds).map(|_| [one(0), one(1)]).collect();
    let median = |which: usize, time: &dyn Fn(&Cost) -> Duration| {
        let mut times: Vec<Duration> = rounds.iter().map(|round| time(&round[which])).collect();
        times.sort();
        1e3 * times[times.len() / 2].as_secs_f64()
    };
    let print = |name: &str, time: &dyn Fn(&Cost) -> Duration| {
        let [open, confined] = [0, 1].map(|which| median(which, time));
        let ratio = confined / open;
        println!("{what:18}{name:14}{open:8.1} and {confined:8.1} ms, {ratio:.3} ×");
    };
    print("CPU", &|cost| cost.cpu);
    print("by the clock", &|cost| cost.wall);
}
