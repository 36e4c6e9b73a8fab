//! What a submission costs in a class, kept apart at the best level that there is, beside the floor: one
//! bare `rustc` call for the same five files (`grader/benches/README.md`).
//!
//! In each round all submissions are changed, and nothing of an earlier round can be used again.

#[path = "../../benches/warm_grade/bare.rs"]
#[allow(
    dead_code,
    reason = "of the compiler's calls the floor alone is made here"
)]
mod bare;
#[path = "../../benches/warm_grade/changed.rs"]
#[allow(dead_code, reason = "a class is a folder of folders")]
mod changed;
#[path = "../../benches/warm_grade/cost.rs"]
mod cost;
#[path = "../../benches/warm_grade/median.rs"]
mod median;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{fs, iter, thread};

use grader::workspace::Workspace;
use tempfile::TempDir;

use bare::BareRustc;
use changed::{baseline, change, copy};
use cost::Cost;
use median::median;

const ROUNDS: usize = 5;
const STUDENTS: usize = 60;

/// How often the floor is measured before the class is graded, and after it again: a call takes a third
/// of a second, in which a shared machine may be slow or fast.
const FLOORS: usize = 5;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let alone = baseline(&root);
    let class = TempDir::new().expect("there is room for a folder");
    let students = (0..STUDENTS).map(|number| class.path().join(format!("student-{number}")));
    let students: Vec<PathBuf> = students.collect();
    for student in &students {
        fs::create_dir(student).expect("there is room for a folder");
        copy(&root, student);
    }
    // What all are built with is made before anything is measured.
    grade(class.path());
    let workspace = Workspace::find().expect("it is around us");
    let bare = BareRustc::prepare(&workspace.output_folder().join("dependencies"));
    let floors = || {
        let compile = || Cost::of_program(&mut bare.compile(alone.path()));
        iter::repeat_with(compile).take(FLOORS)
    };

    let cores = thread::available_parallelism().map_or(1, usize::from);
    println!("{STUDENTS} submissions on {cores} cores, {ROUNDS} rounds");
    println!("  F, CPU ms   each, CPU ms   of F   by the clock, of cores / F");
    let (mut of_floor, mut of_most) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS {
        for (number, student) in students.iter().enumerate() {
            change(&root, student, round * STUDENTS + number);
        }
        change(&root, alone.path(), round);
        let before: Vec<Cost> = floors().collect();
        let Cost { wall, cpu } = grade(class.path());
        let floors = before.into_iter().chain(floors());
        let floor = median(floors.map(|cost| cost.cpu.as_secs_f64()));

        let each = cpu.as_secs_f64() / STUDENTS as f64;
        let throughput = STUDENTS as f64 / wall.as_secs_f64();
        let most = cores as f64 / floor;
        of_floor.push(each / floor);
        of_most.push(throughput / most);
        println!(
            "{:11.0} {:14.0} {:6.2} {:28.2}",
            1e3 * floor,
            1e3 * each,
            each / floor,
            throughput / most
        );
    }
    let [of_floor, of_most] = [of_floor, of_most].map(median);
    println!("median {of_floor:26.2} {of_most:28.2}");
}

/// All of them, once more.
fn grade(class: &Path) -> Cost {
    let out = TempDir::new().expect("there is room for a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
    command.arg(class).arg("--out").arg(out.path());
    command.stderr(Stdio::null());
    Cost::of_program(&mut command)
}
