//! The recipes for schedulers. They are run for real or checked against published schemas.

#[cfg(target_os = "linux")]
mod cluster;
mod kubernetes;
#[cfg(unix)]
mod parallel;
mod schema;
#[cfg(target_os = "linux")]
mod slurm;
mod workflows;

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::harness::{TestClass, exit_code_and_stderr, workspace};

const ITEMS: [&str; 1] = ["camera.offset"];

/// Returns the path of a recipe.
fn recipe(name: &str) -> PathBuf {
    workspace().join("grader/class/recipes").join(name)
}

/// Returns a command that runs a recipe with the test's binary instead of `cargo class`.
fn recipe_command(name: &str, class: &TestClass, exam: &str, out: &Path) -> Command {
    let mut command = Command::new("bash");
    command
        .arg(recipe(name))
        .current_dir(workspace())
        .env("CLASS", env!("CARGO_BIN_EXE_class"))
        .env("INPUT", class.input())
        .env("OUT", out)
        .env("EXAM", exam)
        .env("OPTIONS", "--no-reference --isolation none --cpu-limit 1");
    command
}

/// Panics if a command would grade with the practice exam, which students know, or without the
/// class's policy.
fn assert_exam_and_policy(command: &str) {
    for option in ["--exam ", "--policy ", "$OPTIONS"] {
        assert!(command.contains(option), "{option}: {command}");
    }
}

/// Returns whether a test's requirement is installed. Panics if it is missing and `CI` is set.
fn is_installed(what: &str, found: bool) -> bool {
    if !found {
        assert!(std::env::var_os("CI").is_none(), "{what} is not installed");
        eprintln!("SKIPPED: {what} is not installed");
    }
    found
}

/// Both recipes refuse these mistakes before submitting anything, so no scheduler is needed.
#[test]
fn another_number_of_parts_and_results_among_the_submissions_are_refused() {
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    for name in ["slurm.sh", "parallel.sh"] {
        let refused = |out: &Path, why: &str| {
            let mut run = recipe_command(name, &class, &exam, out);
            let (code, error) = exit_code_and_stderr(&run.env("SHARDS", "3").output().unwrap());
            assert_eq!(code, 2, "{name}: {error}");
            assert!(error.contains(why), "{name}: {error}");
        };
        let shards = class.out().join("shards");
        std::fs::create_dir_all(&shards).unwrap();
        std::fs::write(shards.join("count"), "2\n").unwrap();
        refused(&class.out(), "was graded with SHARDS=2: set SHARDS=2");

        let inside = class.input().join("graded");
        refused(&inside, "would be mistaken for submissions");
        refused(
            &class.input().join("ann/../graded"),
            "choose a different OUT",
        );
        assert!(!inside.exists());
    }
}
