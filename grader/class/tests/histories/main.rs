//! Histories of a class: random sequences of grading, regrading, merging, and changes to
//! submissions, exams and policies, during which runs are killed at any file operation, disks fill
//! up and processes fail to start. After each step, the files must be allowed by a model, and
//! successful runs must produce the same bytes as a run in a new folder.
//!
//! `cargo test -p class --test histories` runs 100 histories, or fewer if one fails.
//! `-- --count 10000` runs that many, even if some fail, and `-- --seed 17` runs only the history
//! with this seed. Nothing is compiled: the scores were recorded beforehand.

mod comparison;
mod faulty_disk;
mod history;
mod model;
mod observed;
mod recorded_grader;
mod world;

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, Stdio};
use std::thread;

use clap::Parser;

/// The default number of histories.
const DEFAULT_COUNT: u64 = 100;

/// Runs random histories of a class.
#[derive(Clone, Debug, Parser)]
struct Arguments {
    /// Number of histories to run, even if some fail; default: up to 100, stopping at the first
    /// failure
    #[arg(long)]
    count: Option<u64>,
    /// Seed of the first history
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// Run only the history with this seed
    #[arg(long)]
    seed: Option<u64>,
    /// Number of processes; default: one per core
    #[arg(long)]
    jobs: Option<u64>,
    /// Write the result into the table of long runs
    #[arg(long)]
    record: bool,
    /// Run the histories in this process, and write any failures to this file
    #[arg(long, hide = true)]
    report: Option<PathBuf>,
    /// Stop at the first history that fails
    #[arg(long, hide = true)]
    until_lost: bool,
    /// Words that test runners add
    #[arg(hide = true)]
    _words: Vec<String>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let seeds = match arguments.seed {
        Some(seed) => seed..seed + 1,
        None => arguments.from..arguments.from + arguments.count.unwrap_or(DEFAULT_COUNT),
    };
    let until_lost = arguments.until_lost || arguments.count.is_none();
    match &arguments.report {
        Some(report) => run_here(seeds, report, arguments.until_lost),
        None => {
            let result = run_in_processes(&seeds, arguments.jobs, until_lost);
            if arguments.record && !record(&seeds, &result) {
                return ExitCode::FAILURE;
            }
            if result.ends_with(" lost 0") {
                ExitCode::SUCCESS
            } else {
                ExitCode::FAILURE
            }
        }
    }
}

/// Runs histories in this process. The commands print their usual output, which the parent process
/// ignores.
fn run_here(seeds: Range<u64>, report: &Path, until_lost: bool) -> ExitCode {
    faulty_disk::install();
    let lost = seeds.filter_map(|seed| Some((seed, history::run(seed).err()?)));
    let lost = lost.map(|(seed, what)| format!("\0history {seed}: {what}\n"));
    let most = if until_lost { 1 } else { usize::MAX };
    fs::write(report, lost.take(most).collect::<String>()).unwrap();
    ExitCode::SUCCESS
}

/// Formats a number with commas as thousands separators.
fn in_thousands(number: u64) -> String {
    match number / 1000 {
        0 => number.to_string(),
        thousands => format!("{},{:03}", in_thousands(thousands), number % 1000),
    }
}

/// Writes the result into the table of long runs. Returns whether that succeeded.
fn record(seeds: &Range<u64>, result: &str) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let script = Command::new("bash")
        .current_dir(root)
        .args([
            ".ci/record",
            "histories",
            &format!("{}..{}", seeds.start, seeds.end),
            result,
        ])
        .status();
    script.is_ok_and(|status| status.success())
}

/// Runs histories in several processes and prints failures. Returns the closing line.
fn run_in_processes(seeds: &Range<u64>, jobs: Option<u64>, until_lost: bool) -> String {
    let cores = || thread::available_parallelism().map_or(1, |cores| cores.get() as u64);
    let count = seeds.end - seeds.start;
    let jobs = jobs.unwrap_or_else(cores).clamp(1, count.max(1));
    let folder = tempfile::tempdir().unwrap();
    let report = |job: u64| folder.path().join(job.to_string());
    let start = |job: u64| -> Child {
        let bound = |job: u64| seeds.start + count * job / jobs;
        let (from, count) = (bound(job), bound(job + 1) - bound(job));
        Command::new(std::env::current_exe().unwrap())
            .args(["--from", &from.to_string(), "--count", &count.to_string()])
            .arg("--report")
            .arg(report(job))
            .args(until_lost.then_some("--until-lost"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    };
    let children: Vec<Child> = (0..jobs).map(start).collect();
    let mut lost = Vec::new();
    for (job, mut child) in (0..).zip(children) {
        if until_lost && !lost.is_empty() {
            // The process may already have ended.
            let _ = child.kill();
        }
        let status = child.wait().unwrap();
        match fs::read_to_string(report(job)) {
            Ok(text) => lost.extend(text.split('\0').skip(1).map(str::to_owned)),
            Err(_) if until_lost && !lost.is_empty() => {}
            Err(_) => lost.push(format!(
                "a process ended with {status}: run fewer histories\n"
            )),
        }
    }
    for text in lost.iter().take(5) {
        println!("{text}");
    }
    if !lost.is_empty() {
        println!("`cargo test -p class --test histories -- --seed NUMBER` repeats one");
    }
    let more = if until_lost && !lost.is_empty() {
        " or more"
    } else {
        ""
    };
    let result = format!(
        "histories {}, lost {}{more}",
        in_thousands(count),
        lost.len()
    );
    println!("{result}");
    result
}
