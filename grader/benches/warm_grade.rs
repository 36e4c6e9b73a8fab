//! What grading costs beside compiling: `cargo grade` of a changed submission, whole exam included,
//! and `cargo grade --watch` from a save to the whole report, against the bare `rustc` call for the
//! same five files (with the given `lib.rs` and `primitive.rs`; everything else prebuilt). Turn by
//! turn, so that a noisy machine disturbs all.
//!
//! `cargo bench -p grader` prints the medians and their ratios.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const ROUNDS: usize = 15;
const FIVE: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];
const GIVEN: [&str; 2] = ["lib.rs", "primitive.rs"];

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let submission = || {
        let folder = TempDir::new().expect("there is room for a folder");
        for file in FIVE.into_iter().chain(GIVEN) {
            let source = root.join("reference/src").join(file);
            fs::copy(source, folder.path().join(file)).expect("the reference is there");
        }
        folder
    };
    let (folder, watched) = (submission(), submission());
    // The probe's way in needs `world`, the floor does not.
    let lib = folder.path().join("lib.rs");
    let text = fs::read_to_string(&lib).expect("it was copied");
    fs::write(&lib, text.replace("pub mod world;\n", "")).expect("it can be written");

    grade(folder.path());
    let dependencies = newest_dependencies(&root.join("target/grade/dependencies"));
    let mut watch = Watch::start(watched.path());
    let mut rounds = Vec::new();
    for round in 0..ROUNDS {
        change(folder.path(), round);
        let floor = timed(&mut floor(folder.path(), &dependencies));
        let whole = grade(folder.path());
        change(watched.path(), round);
        rounds.push([floor, whole, watch.report()].map(|took| took.as_secs_f64()));
    }

    let median = |of: &dyn Fn(&[f64; 3]) -> f64| {
        let mut values: Vec<f64> = rounds.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[ROUNDS / 2]
    };
    println!("wall time, median of {ROUNDS} rounds");
    let names = [
        "bare rustc of the five files",
        "cargo grade, whole exam",
        "cargo grade --watch, from a save",
    ];
    for (which, name) in names.iter().enumerate() {
        let milliseconds = 1e3 * median(&|round| round[which]);
        let ratio = median(&|round| round[which] / round[0]);
        println!("{name:34}{milliseconds:>6.0} ms{ratio:>8.2}");
    }
}

/// A grader that waits for saves.
struct Watch {
    child: Child,
    lines: BufReader<ChildStdout>,
}

impl Watch {
    fn start(folder: &Path) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.arg("--watch").arg(folder);
        command.arg("--out").arg(folder.join("out"));
        let child = command.stdout(Stdio::piped()).spawn();
        let mut child = child.expect("it can be started");
        let lines = BufReader::new(child.stdout.take().expect("it is a pipe"));
        let mut watch = Watch { child, lines };
        watch.report();
        watch
    }

    /// How long the next report is in coming.
    fn report(&mut self) -> Duration {
        let start = Instant::now();
        let mut line = String::new();
        while !line.contains("save a file to grade again") {
            line.clear();
            let read = self.lines.read_line(&mut line).expect("it writes text");
            assert!(read > 0, "it has ended");
        }
        start.elapsed()
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Really changes the submission: a constant in two hot functions.
fn change(folder: &Path, round: usize) {
    for (file, place) in [
        ("sphere.rs", "discriminant < 0.0"),
        ("triangle.rs", "determinant == 0.0"),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../reference/src")
            .join(file);
        let text = fs::read_to_string(path).expect("the reference is there");
        assert!(text.contains(place), "{file} has no {place}");
        let changed = text.replace(place, &format!("{place} || ray.range.max < -{round}.5"));
        fs::write(folder.join(file), changed).expect("it can be written");
    }
}

fn grade(folder: &Path) -> Duration {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg(folder).arg("--out").arg(folder.join("out"));
    command.args(["--require", "100"]);
    timed(&mut command)
}

fn timed(command: &mut Command) -> Duration {
    let start = Instant::now();
    let status = command
        .stdout(Stdio::null())
        .status()
        .expect("it can be started");
    assert!(status.success(), "{command:?} failed");
    start.elapsed()
}

fn floor(folder: &Path, dependencies: &Value) -> Command {
    let rustc = Path::new(env!("CARGO")).with_file_name("rustc");
    let mut command = Command::new(rustc);
    command.current_dir(folder);
    command.args(["--edition=2024", "--crate-name=floor", "--crate-type=rlib"]);
    command.args(["-Copt-level=2", "-Ccodegen-units=1", "-Cdebuginfo=0"]);
    command.args(["-Coverflow-checks=on", "-Awarnings", "lib.rs"]);
    let text = |value: &Value| value.as_str().expect("it is a path").to_owned();
    command.arg(format!("-Ldependency={}", text(&dependencies["folder"])));
    for (name, rlib) in dependencies["externs"].as_object().expect("it is a map") {
        command
            .arg("--extern")
            .arg(format!("{name}={}", text(rlib)));
    }
    command
}

/// What the run before has just used.
fn newest_dependencies(cache: &Path) -> Value {
    let entries = fs::read_dir(cache)
        .expect("a grade has filled it")
        .flatten();
    let records = entries.map(|entry| entry.path().join("dependencies.json"));
    let newest: Option<PathBuf> = records
        .filter(|record| record.is_file())
        .max_by_key(|record| fs::metadata(record).and_then(|file| file.modified()).ok());
    let text = fs::read(newest.expect("a grade has filled it")).expect("it can be read");
    serde_json::from_slice(&text).expect("the grader wrote it")
}
