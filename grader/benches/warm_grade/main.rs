//! Measures the overhead of grading compared with compiling, for the table in `../README.md`.
//!
//! Each round changes the submission and then measures each quantity once, so that a busy machine
//! affects all of them. CPU times are compared within a round.

mod wire;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use bench_support::{BareRustc, Cost, baseline, change, median, repetitions, submission};
use grader::build::Builder;
use grader::grade::default_folder;
use grader::handed_out::RAYS;
use grader::submission::Submission;
use grader::workspace::Workspace;

use test_support::WatchProcess;

const ROUNDS: usize = 15;

/// The measured quantities, in the order in which each round measures them, and the baseline that
/// each of them is compared with.
const ROWS: [Row; 7] = [
    Row::new("bare rustc on the task files (F)", "F", TimeKind::Cpu),
    Row::new("the same, up to type checking (T)", "F", TimeKind::Cpu),
    Row::new("changed submission to probe", "F", TimeKind::Cpu),
    Row::new("changed submission to score.json", "F", TimeKind::Cpu),
    // The CPU time is unknown while a process is still running.
    Row::new("time to the first compile error", "T", TimeKind::Wall),
    Row::new("--watch: save to complete score", "F", TimeKind::Wall),
    Row::new("unchanged: cached report", "F", TimeKind::Cpu),
];

/// A row of the table.
struct Row {
    name: &'static str,
    baseline: &'static str,
    time: TimeKind,
}

/// The kind of time to compare.
#[derive(Clone, Copy)]
enum TimeKind {
    Cpu,
    Wall,
}

impl Row {
    const fn new(name: &'static str, baseline: &'static str, time: TimeKind) -> Self {
        Row {
            name,
            baseline,
            time,
        }
    }

    fn ratio(&self, cost: Cost, [f, t]: [Cost; 2]) -> f64 {
        let against = match self.baseline {
            "T" => t,
            _ => f,
        };
        match self.time {
            TimeKind::Cpu => cost.cpu.as_secs_f64() / against.cpu.as_secs_f64(),
            TimeKind::Wall => cost.wall.as_secs_f64() / against.wall.as_secs_f64(),
        }
    }
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = baseline(&root);
    let [broken, watched, same] = [(); 3].map(|()| submission(&root));

    grade(folder.path(), 100);
    let workspace = Workspace::find().expect("the benchmark runs in the workspace");
    let builder = Builder::prepare(&workspace).expect("the dependencies can be built");
    let bare = BareRustc::prepare(&workspace.cache_folder().join("dependencies"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(watched.path());
    command.arg("--out").arg(watched.path().join("out"));
    let mut watcher = WatchProcess::start(&mut command);
    watcher.report();
    let mut rounds = Vec::new();
    for round in 0..repetitions(ROUNDS) {
        change(&root, folder.path(), round);
        let bare_rustc = Cost::of_program(&mut bare.compile(folder.path()));
        let types = Cost::of_program(&mut bare.check(folder.path()));
        let probe = Cost::of(|| {
            let changed =
                Submission::collect(folder.path(), &RAYS).expect("the submission can be read");
            let build = builder
                .build(&changed)
                .expect("the submission can be built");
            assert!(build.probe.is_some(), "the reference compiles");
        });
        let score = grade(folder.path(), 100);
        change(&root, broken.path(), round);
        break_file(&broken.path().join("sphere.rs"));
        let error = first_error(broken.path());
        let saved = Cost::of(|| {
            change(&root, watched.path(), round);
            watcher.report();
        });
        let cached = regrade_unchanged(same.path());
        rounds.push([bare_rustc, types, probe, score, error, saved, cached]);
    }
    print(&rounds);
    drop(watcher);
    let unchanged = Submission::collect(same.path(), &RAYS).expect("the submission can be read");
    fs::remove_dir_all(default_folder(&workspace, &unchanged))
        .expect("the folder with the score can be removed");

    let world = submission(&root);
    let given = root.join("grader/starter/world.rs");
    fs::copy(given, world.path().join("world.rs")).expect("the starter can be copied");
    let submission = Submission::collect(world.path(), &RAYS).expect("the submission can be read");
    let build = builder
        .build(&submission)
        .expect("the submission can be built");
    let program = build.probe.as_deref().expect("the reference compiles");
    wire::compare(world.path(), &bare, &build.launcher(program));
}

fn print(rounds: &[[Cost; ROWS.len()]]) {
    println!(
        "median of {} rounds; each ratio compares times from the same round",
        rounds.len()
    );
    println!("{:36}{:>9}{:>9}{:>8}", "", "wall ms", "CPU ms", "ratio");
    for (which, row) in ROWS.iter().enumerate() {
        let costs = || rounds.iter().map(|round| round[which]);
        let wall = 1e3 * median(costs().map(|cost| cost.wall.as_secs_f64()));
        let cpu = match row.time {
            TimeKind::Cpu => 1e3 * median(costs().map(|cost| cost.cpu.as_secs_f64())),
            TimeKind::Wall => f64::NAN,
        };
        let ratio = median(
            rounds
                .iter()
                .map(|round| row.ratio(round[which], [round[0], round[1]])),
        );
        let (name, baseline) = (row.name, row.baseline);
        println!("{name:36}{wall:>9.0}{cpu:>9.0}{ratio:>8.2} {baseline}");
    }
}

/// Measures the time until the first error is printed for a file that doesn't compile. The other
/// files are graded after that.
fn first_error(folder: &Path) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut first_line = String::new();
    let mut child = None;
    let cost = Cost::of(|| {
        let child = child.insert(command.spawn().expect("the grader can be started"));
        let stderr = child.stderr.take().expect("the stream is piped");
        let read = BufReader::new(stderr).read_line(&mut first_line);
        read.expect("the grader writes text");
    });
    let (file, error) = first_line.split_once(": error").unwrap_or_default();
    assert!(
        file.contains("sphere.rs:") && !error.is_empty(),
        "{first_line}"
    );
    child
        .expect("the grader was started")
        .wait()
        .expect("the grader ends");
    cost
}

/// Adds a type error to a file.
fn break_file(file: &Path) {
    let text = fs::read_to_string(file).expect("the file was written");
    fs::write(file, format!("{text}\nconst RADIUS: f32 = \"one\";\n"))
        .expect("the file can be written");
}

/// Grades a submission in its default folder and then measures the cost of grading it again without
/// any change.
fn regrade_unchanged(folder: &Path) -> Cost {
    let grader = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.arg(folder);
        command
    };
    Cost::of_program(&mut grader());
    let mut stdout = Vec::new();
    let cost = Cost::of(|| stdout = grader().output().expect("the grader can be started").stdout);
    let printed = String::from_utf8_lossy(&stdout);
    assert!(printed.contains("Nothing has changed"), "{printed}");
    cost
}

fn grade(folder: &Path, required: u32) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.args(["--require", &required.to_string()]);
    Cost::of_program(&mut command)
}
