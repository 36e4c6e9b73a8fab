//! What grading costs beside compiling: the table of `README.md` in the folder above.
//!
//! Every round changes the submission, and then does each thing once, turn by turn, so that a noisy
//! machine disturbs all. What is compared is CPU time, of one round.

mod bare;
mod cost;
mod watching;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use grader::build::Builder;
use grader::submission::Submission;
use grader::workspace::Workspace;
use tempfile::TempDir;

use bare::Bare;
use cost::Cost;
use watching::Watching;

const ROUNDS: usize = 15;
const FIVE: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];
const GIVEN: [&str; 2] = ["lib.rs", "primitive.rs"];

/// What is measured, in the order of one round; the first two are what the others are compared with.
const NAMES: [&str; 6] = [
    "bare rustc of the five files (F)",
    "the same as far as types (T)",
    "changed submission to probe",
    "changed submission to score.json",
    "does not compile: until it is said",
    "--watch: save to report",
];
const F: usize = 0;
const T: usize = 1;
const NOT_COMPILING: usize = 4;
const WATCH: usize = 5;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (folder, broken, watched) = (submission(&root), submission(&root), submission(&root));
    // The probe's way in needs `world`, the floor does not.
    let lib = folder.path().join("lib.rs");
    let text = fs::read_to_string(&lib).expect("it was copied");
    fs::write(&lib, text.replace("pub mod world;\n", "")).expect("it can be written");

    grade(folder.path(), 100);
    let workspace = Workspace::find().expect("it is around us");
    let builder = Builder::prepare(&workspace).expect("it was prepared");
    let bare = Bare::prepare(&workspace.grade().join("dependencies"));
    let mut watching = Watching::start(watched.path());
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
        spoil(&broken.path().join("sphere.rs"));
        let told = until_told(broken.path());
        let saved = Cost::of(|| {
            change(&root, watched.path(), round);
            watching.report();
        });
        rounds.push([floor, types, probe, whole, told, saved]);
    }
    print(&rounds);
}

fn print(rounds: &[[Cost; NAMES.len()]]) {
    println!("median of {} rounds; ratios within one round", rounds.len());
    println!("{:36}{:>9}{:>9}{:>12}", "", "wall ms", "CPU ms", "ratio");
    for (which, name) in NAMES.into_iter().enumerate() {
        let wall = median(rounds.iter().map(|round| round[which].wall.as_secs_f64()));
        let cpu = median(rounds.iter().map(|round| round[which].cpu.as_secs_f64()));
        let (unit, against) = match which {
            NOT_COMPILING => ("T", T),
            _ => ("F", F),
        };
        let ratio = |round: &[Cost; NAMES.len()]| match which {
            // What a program uses that goes on is not known: wall time it is.
            WATCH => round[which].wall.as_secs_f64() / round[against].wall.as_secs_f64(),
            _ => round[which].cpu.as_secs_f64() / round[against].cpu.as_secs_f64(),
        };
        let ratio = median(rounds.iter().map(ratio));
        let cpu = match which {
            WATCH => String::new(),
            _ => format!("{:.0}", cpu * 1e3),
        };
        println!("{name:36}{:>9.0}{cpu:>9}{ratio:>10.2} {unit}", wall * 1e3);
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn submission(root: &Path) -> TempDir {
    let folder = TempDir::new().expect("there is room for a folder");
    for file in FIVE.into_iter().chain(GIVEN) {
        let source = root.join("reference/src").join(file);
        fs::copy(source, folder.path().join(file)).expect("the reference is there");
    }
    folder
}

/// Really changes the submission: a constant in two hot functions.
fn change(root: &Path, folder: &Path, round: usize) {
    for (file, place) in [
        ("sphere.rs", "discriminant < 0.0"),
        ("triangle.rs", "determinant == 0.0"),
    ] {
        let path = root.join("reference/src").join(file);
        let text = fs::read_to_string(path).expect("the reference is there");
        assert!(text.contains(place), "{file} has no {place}");
        let changed = text.replace(place, &format!("{place} || ray.range.max < -{round}.5"));
        fs::write(folder.join(file), changed).expect("it can be written");
    }
}

/// Until the first word on a file that does not compile. The rest is graded after that, and not
/// waited for.
fn until_told(folder: &Path) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    let mut said = String::new();
    let cost = Cost::of(|| {
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        let mut child = child.expect("it can be started");
        let words = child.stderr.take().expect("it is a pipe");
        let read = BufReader::new(words).read_line(&mut said);
        read.expect("it writes text");
        child.kill().expect("it is ours");
        child.wait().expect("it is ours");
    });
    assert!(said.starts_with("sphere.rs: error"), "{said}");
    cost
}

/// An error of types.
fn spoil(file: &Path) {
    let text = fs::read_to_string(file).expect("it was written");
    fs::write(file, format!("{text}\nconst RADIUS: f32 = \"one\";\n")).expect("it can be written");
}

fn grade(folder: &Path, required: u32) -> Cost {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.args(["--require", &required.to_string()]);
    Cost::of_program(&mut command, true)
}
