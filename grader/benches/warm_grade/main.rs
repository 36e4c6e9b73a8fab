//! What grading costs beside compiling: the table of `README.md` in the folder above.
//!
//! Every round changes the submission, and then does each thing once, turn by turn, so that a noisy
//! machine disturbs all. What is compared is CPU time, of one round.

mod bare;
mod changed;
mod cost;
mod median;
mod watch;
mod wire;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use grader::build::Builder;
use grader::submission::Submission;
use grader::workspace::Workspace;

use bare::BareRustc;
use changed::{baseline, change, submission};
use cost::Cost;
use median::median;
use watch::WatchProcess;

const ROUNDS: usize = 15;

/// What is measured, in the order of one round, and what it is compared with.
const ROWS: [Row; 7] = [
    Row::new("bare rustc of the five files (F)", "F", TimeKind::Cpu),
    Row::new("the same as far as types (T)", "F", TimeKind::Cpu),
    Row::new("changed submission to probe", "F", TimeKind::Cpu),
    Row::new("changed submission to score.json", "F", TimeKind::Cpu),
    // What a program has used so far that goes on is not known.
    Row::new("does not compile: until it is said", "T", TimeKind::Wall),
    Row::new("--watch: save to all points", "F", TimeKind::Wall),
    Row::new("unchanged: told again", "F", TimeKind::Cpu),
];

/// One line of the table.
struct Row {
    name: &'static str,
    baseline: &'static str,
    time: TimeKind,
}

/// Which time is compared.
#[derive(Clone, Copy)]
enum TimeKind {
    Cpu,
    Wall,
}

impl Row {
    const fn new(name: &'static str, unit: &'static str, by: TimeKind) -> Self {
        Row {
            name,
            baseline: unit,
            time: by,
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
    let workspace = Workspace::find().expect("it is around us");
    let builder = Builder::prepare(&workspace).expect("it was prepared");
    let bare = BareRustc::prepare(&workspace.output_folder().join("dependencies"));
    let mut watching = WatchProcess::start(watched.path());
    let mut rounds = Vec::new();
    for round in 0..ROUNDS {
        change(&root, folder.path(), round);
        let floor = Cost::of_program(&mut bare.compile(folder.path()));
        let types = Cost::of_program(&mut bare.check(folder.path()));
        let probe = Cost::of(|| {
            let changed = Submission::collect(folder.path()).expect("it is there");
            let build = builder.build(&changed).expect("it can be built");
            assert!(build.probe.is_some(), "the reference compiles");
        });
        let whole = grade(folder.path(), 100);
        change(&root, broken.path(), round);
        break_file(&broken.path().join("sphere.rs"));
        let told = first_error(broken.path());
        let saved = Cost::of(|| {
            change(&root, watched.path(), round);
            watching.report();
        });
        let again = regrade_unchanged(same.path());
        rounds.push([floor, types, probe, whole, told, saved, again]);
    }
    print(&rounds);
    drop(watching);
    let name = same.path().file_name().expect("it has a name");
    fs::remove_dir_all(workspace.output_folder().join(name)).expect("it was graded there");

    let world = submission(&root);
    let given = root.join("grader/starter/world.rs");
    fs::copy(given, world.path().join("world.rs")).expect("it is there");
    let submission = Submission::collect(world.path()).expect("it is there");
    let build = builder.build(&submission).expect("it can be built");
    let program = build.probe.as_deref().expect("the reference compiles");
    wire::compare(world.path(), &bare, &build.launcher(program));
}

fn print(rounds: &[[Cost; ROWS.len()]]) {
    println!("median of {} rounds; ratios within one round", rounds.len());
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
        let (name, unit) = (row.name, row.baseline);
        println!("{name:36}{wall:>9.0}{cpu:>9.0}{ratio:>8.2} {unit}");
    }
}

/// Until the first word on a file that does not compile. The rest is graded after that.
fn first_error(folder: &Path) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut said = String::new();
    let mut child = None;
    let cost = Cost::of(|| {
        let child = child.insert(command.spawn().expect("it can be started"));
        let words = child.stderr.take().expect("it is a pipe");
        let read = BufReader::new(words).read_line(&mut said);
        read.expect("it writes text");
    });
    assert!(said.starts_with("sphere.rs: error"), "{said}");
    child
        .expect("it was started")
        .wait()
        .expect("it comes to an end");
    cost
}

/// An error of types.
fn break_file(file: &Path) {
    let text = fs::read_to_string(file).expect("it was written");
    fs::write(file, format!("{text}\nconst RADIUS: f32 = \"one\";\n")).expect("it can be written");
}

/// A submission that has not changed, in its usual place. The first time, it is graded.
fn regrade_unchanged(folder: &Path) -> Cost {
    let grader = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.arg(folder);
        command
    };
    Cost::of_program(&mut grader());
    Cost::of_program(&mut grader())
}

fn grade(folder: &Path, required: u32) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.args(["--require", &required.to_string()]);
    Cost::of_program(&mut command)
}
