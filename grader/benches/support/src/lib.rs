//! Code shared by the benchmarks for the grader and those for a class. `grader/benches/README.md`
//! explains what they measure.
//!
//! Unix only, like the benchmarks, because other systems don't report the CPU time of child
//! processes.

#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;
use serde_json::Value;
use tempfile::TempDir;

/// The wall time and CPU time of an operation. On a busy machine, only CPU times can be compared.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Wall time.
    pub wall: Duration,
    /// CPU time of this process and of its children.
    pub cpu: Duration,
}

impl Cost {
    /// Measures a function.
    pub fn of(work: impl FnOnce()) -> Cost {
        let (wall, cpu) = (Instant::now(), used());
        work();
        Cost {
            wall: wall.elapsed(),
            cpu: used() - cpu,
        }
    }

    /// Measures a run of a program. Panics if the program fails.
    pub fn of_program(command: &mut Command) -> Cost {
        Cost::of(|| {
            let status = command.stdout(Stdio::null()).status();
            let status = status.expect("the program can be started");
            assert!(status.success(), "{command:?} failed");
        })
    }
}

/// Returns the CPU time used so far. The CPU time of a child process is included once the child has
/// been waited for.
fn used() -> Duration {
    let [own, children] = [UsageWho::RUSAGE_SELF, UsageWho::RUSAGE_CHILDREN].map(|who| {
        let usage = getrusage(who).expect("the system reports CPU time");
        duration(usage.user_time()) + duration(usage.system_time())
    });
    own + children
}

fn duration(time: TimeVal) -> Duration {
    let micros = time.tv_sec() * 1_000_000 + time.tv_usec();
    Duration::from_micros(u64::try_from(micros).expect("CPU time is not negative"))
}

/// The baseline: one `rustc` call for the task files and the given `lib.rs` and `primitive.rs`,
/// with or without code generation. All their dependencies are already compiled.
pub struct BareRustc {
    dependencies: Value,
}

impl BareRustc {
    /// Prepares calls that use the dependencies compiled for the most recent grading run.
    pub fn prepare(cache: &Path) -> Self {
        BareRustc {
            dependencies: newest(cache),
        }
    }

    /// Returns the command that compiles the task files.
    pub fn compile(&self, folder: &Path) -> Command {
        self.rustc(
            folder,
            &["--crate-name=baseline", "--crate-type=rlib", "lib.rs"],
        )
    }

    /// Returns the command that checks the task files for errors.
    pub fn check(&self, folder: &Path) -> Command {
        let mut command = self.compile(folder);
        command.arg("--emit=metadata");
        command
    }

    /// Returns the command that compiles the task files into a program, with `root` as the crate
    /// root.
    pub fn program(&self, folder: &Path, root: &str) -> Command {
        self.rustc(folder, &["--crate-type=bin", root])
    }

    fn rustc(&self, folder: &Path, arguments: &[&str]) -> Command {
        // This bypasses rustup's proxy, which takes 8 ms.
        let rustc = Path::new(env!("CARGO")).with_file_name("rustc");
        let mut command = Command::new(rustc);
        command.current_dir(folder);
        command.arg("--edition=2024").args(arguments);
        command.args(["-Copt-level=2", "-Ccodegen-units=1", "-Cdebuginfo=0"]);
        command.args(["-Coverflow-checks=on", "-Awarnings"]);
        let text = |value: &Value| value.as_str().expect("the value is a path").to_owned();
        let folder = text(&self.dependencies["folder"]);
        command.arg(format!("-Ldependency={folder}"));
        let externs = self.dependencies["externs"].as_object();
        for (name, rlib) in externs.expect("the value is a map") {
            command
                .arg("--extern")
                .arg(format!("{name}={}", text(rlib)));
        }
        command
    }
}

fn newest(cache: &Path) -> Value {
    let entries = fs::read_dir(cache)
        .expect("a grading run has filled the cache")
        .flatten();
    let records = entries.map(|entry| entry.path().join("dependencies.json"));
    let newest: Option<PathBuf> = records
        .filter(|record| record.is_file())
        .max_by_key(|record| fs::metadata(record).and_then(|file| file.modified()).ok());
    let text = fs::read(newest.expect("a grading run has filled the cache"))
        .expect("the record can be read");
    serde_json::from_slice(&text).expect("the grader wrote valid JSON")
}

/// Returns a new folder with the reference's files.
pub fn submission(root: &Path) -> TempDir {
    let folder = TempDir::new().expect("a folder can be created");
    copy(root, folder.path());
    folder
}

/// Returns a new folder with the reference's files, for bare compiler calls. Its `lib.rs` lacks the
/// module `world`, which only the probe needs.
pub fn baseline(root: &Path) -> TempDir {
    let folder = submission(root);
    let lib = folder.path().join("lib.rs");
    let text = fs::read_to_string(&lib).expect("the file was copied");
    fs::write(&lib, text.replace("pub mod world;\n", "")).expect("the file can be written");
    folder
}

/// Copies the reference's files to a folder.
pub fn copy(root: &Path, folder: &Path) {
    let files = fs::read_dir(root.join("reference/src")).expect("there is a reference");
    for file in files.flatten() {
        fs::copy(file.path(), folder.join(file.file_name())).expect("the reference can be read");
    }
}

/// Changes a constant in two hot functions of the submission, so that cached results can't be
/// reused.
pub fn change(root: &Path, folder: &Path, round: usize) {
    for (file, text_to_change) in [
        ("sphere.rs", "discriminant < 0.0"),
        ("triangle.rs", "determinant == 0.0"),
    ] {
        let path = root.join("reference/src").join(file);
        let text = fs::read_to_string(path).expect("the reference can be read");
        assert!(
            text.contains(text_to_change),
            "{file} has no {text_to_change}"
        );
        let changed = text.replace(
            text_to_change,
            &format!("{text_to_change} || ray.range.max < -{round}.5"),
        );
        fs::write(folder.join(file), changed).expect("the file can be written");
    }
}

/// Returns the median, which isn't affected by a few slow runs. For an even number of values,
/// returns the larger of the two middle values.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Returns whether the command line asks for the short form: with `--check`, a benchmark measures
/// everything once to check that it still works.
pub fn is_short() -> bool {
    std::env::args().any(|argument| argument == "--check")
}

/// Returns `full`, or 1 in the short form.
pub fn repetitions(full: usize) -> usize {
    if is_short() { 1 } else { full }
}
