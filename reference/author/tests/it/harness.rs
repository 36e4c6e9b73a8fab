//! Runs `cargo author`, reads files of the workspace, and generates the exams for a few seeds.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{LazyLock, Mutex, PoisonError};

use author::authoring;
use author::bundle::{Bundle, BundleOptions};
use author::exams::assemble;
use author::seed::Seed;
use grader::handed_out::RAYS;
use judging::exam::Exam;

/// Held while solutions are built. Two commands that build the same solutions at the same time
/// would compile each of them twice. If they run one after the other, the second command reuses the
/// first command's programs.
static BUILDS: Mutex<()> = Mutex::new(());
/// The subcommands that build solutions.
const BUILDING: [&str; 4] = ["calibrate", "mistakes", "mutants", "prove"];

/// The students' bundle, collected once for all tests.
pub static BUNDLE: LazyLock<Bundle> =
    LazyLock::new(|| Bundle::collect(&root(), &RAYS, BundleOptions::default()).unwrap());

/// Returns the root folder of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Returns the text of a workspace file.
pub fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Waits until nothing else is building solutions. Others then have to wait until the guard is
/// dropped.
pub fn lock_builds() -> impl Drop {
    BUILDS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs `cargo author` with these arguments.
fn author(arguments: &[impl AsRef<OsStr>]) -> Output {
    let builds = BUILDING.map(OsStr::new).contains(&arguments[0].as_ref());
    let _lock = builds.then(lock_builds);
    let mut author = Command::new(env!("CARGO_BIN_EXE_author"));
    author.args(arguments).output().unwrap()
}

/// Runs `cargo author`, which must succeed. Returns its output.
#[track_caller]
pub fn author_succeeds(arguments: &[impl AsRef<OsStr>]) -> String {
    let output = author(arguments);
    let printed = String::from_utf8(output.stdout).unwrap();
    let problems = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{printed}{problems}");
    printed
}

/// Runs `cargo author`, which must fail. Returns its error.
#[track_caller]
pub fn author_fails(arguments: &[impl AsRef<OsStr>]) -> String {
    let output = author(arguments);
    assert!(!output.status.success(), "{output:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// The seeds that the tests use.
pub const SEEDS: [u64; 2] = [2025, 77];

/// The exam for each seed, without its recorded picture.
static EXAMS: LazyLock<Vec<Exam>> = LazyLock::new(|| SEEDS.map(make_exam).into());

/// Returns the exam for one of the [`SEEDS`].
pub fn exam_of(seed: u64) -> &'static Exam {
    let index = SEEDS.iter().position(|other| *other == seed);
    &EXAMS[index.expect("the seed is in SEEDS")]
}

/// Generates an exam without recording its rendered picture.
fn make_exam(seed: u64) -> Exam {
    assemble(&authoring::RAYS, "test", Seed(seed)).expect("the practice exam is valid")
}
