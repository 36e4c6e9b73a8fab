//! Measures the CPU time that grading a class takes per submission, at the strongest isolation
//! level that the machine supports, and compares it with the baseline F: one bare `rustc` call for
//! the same task files (`grader/benches/README.md`).
//!
//! All submissions change in each round, so that no cached results can be reused.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{fs, iter, thread};

use bench_support::{BareRustc, Cost, baseline, change, copy, is_short, median, repetitions};
use grader::workspace::Workspace;
use tempfile::TempDir;

const ROUNDS: usize = 5;
const STUDENTS: usize = 60;
/// The number of submissions in a short run.
const FEW_STUDENTS: usize = 4;

/// The number of baseline measurements to take before the class is graded, and again afterwards.
/// Several are needed because a call only takes a third of a second and the speed of a shared
/// machine varies.
const BASELINE_CALLS: usize = 5;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let alone = baseline(&root);
    let class = TempDir::new().expect("a temporary folder can be created");
    let count = if is_short() { FEW_STUDENTS } else { STUDENTS };
    let rounds = repetitions(ROUNDS);
    let students = (0..count).map(|number| class.path().join(format!("student-{number}")));
    let students: Vec<PathBuf> = students.collect();
    for student in &students {
        fs::create_dir(student).expect("a temporary folder can be created");
        copy(&root, student);
    }
    // Compile the shared dependencies before measuring anything.
    grade(class.path());
    let workspace = Workspace::find().expect("the benchmark runs in the workspace");
    let bare = BareRustc::prepare(&workspace.cache_folder().join("dependencies"));
    let measure_baseline = || {
        let compile = || Cost::of_program(&mut bare.compile(alone.path()));
        iter::repeat_with(compile).take(repetitions(BASELINE_CALLS))
    };

    let cores = thread::available_parallelism().map_or(1, usize::from);
    println!("{count} submissions on {cores} cores, {rounds} rounds");
    println!("F (CPU ms)  CPU ms each  ratio to F  throughput / (cores / F)");
    let (mut of_baseline, mut of_most) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        for (number, student) in students.iter().enumerate() {
            change(&root, student, round * count + number);
        }
        change(&root, alone.path(), round);
        let before: Vec<Cost> = measure_baseline().collect();
        let Cost { wall, cpu } = grade(class.path());
        let baselines = before.into_iter().chain(measure_baseline());
        let baseline = median(baselines.map(|cost| cost.cpu.as_secs_f64()));

        let each = cpu.as_secs_f64() / count as f64;
        let throughput = count as f64 / wall.as_secs_f64();
        let most = cores as f64 / baseline;
        of_baseline.push(each / baseline);
        of_most.push(throughput / most);
        println!(
            "{:10.0}  {:11.0}  {:10.2}  {:24.2}",
            1e3 * baseline,
            1e3 * each,
            each / baseline,
            throughput / most
        );
    }
    let [of_baseline, of_most] = [of_baseline, of_most].map(median);
    println!("median {of_baseline:28.2}  {of_most:24.2}");
}

/// Grades the class, with a new output folder. Returns the cost.
fn grade(class: &Path) -> Cost {
    let out = TempDir::new().expect("a temporary folder can be created");
    let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
    command.arg(class).arg("--out").arg(out.path());
    command.stderr(Stdio::null());
    Cost::of_program(&mut command)
}
