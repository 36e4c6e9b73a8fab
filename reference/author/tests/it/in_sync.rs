//! The committed generated files are up to date, according to each command's `--check`.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use grader::handed_out::ASSIGNMENTS;
use grader::probe::Budget;
use grader::task_session::{MAX_CRASHES, MAX_TIMEOUTS};

use crate::harness::{author_succeeds, root, text};

/// The folders with generated starters: two identical copies for each assignment.
const STARTERS: [&str; 4] = [
    "student/src",
    "grader/starter",
    "student/light/src",
    "grader/starter/light",
];

/// Returns the starters' files in all folders.
fn starter_files() -> Vec<PathBuf> {
    STARTERS
        .iter()
        .flat_map(|folder| fs::read_dir(root().join(folder)).expect("the starter is committed"))
        .map(|entry| entry.expect("the folder can be listed").path())
        .filter(|path| path.is_file())
        .collect()
}

#[test]
fn the_starter_the_exams_and_the_table_of_mistakes_are_in_sync() {
    for assignment in ["rays", "light"] {
        for command in ["starter", "exams", "mistakes"] {
            author_succeeds(&[command, "--check", "--assignment", assignment]);
        }
    }
}

#[test]
fn every_sentence_of_the_contract_is_covered_or_has_its_reason() {
    for assignment in ["rays", "light"] {
        author_succeeds(&["coverage", "--check", "--assignment", assignment]);
    }
}

#[test]
fn the_handout_is_in_sync_and_its_links_names_and_commands_exist() {
    for assignment in ["rays", "light"] {
        author_succeeds(&["handout", "--check", "--assignment", assignment]);
    }
}

#[test]
fn the_handout_has_the_limits_of_the_grader() {
    let page = text("handout/src/grading.md");
    let page: Vec<&str> = page.split_whitespace().collect();
    let page = page.join(" ");
    let limits = Budget::default().single_item();
    // The second sentence below spells out these numbers.
    assert_eq!((MAX_TIMEOUTS, MAX_CRASHES), (1, 2));
    for sentence in [
        format!(
            "An item may use {} seconds of processor time, or {} times as much as the slowest \
             item of its task that passed, but at most {} seconds.",
            limits.cpu.as_secs(),
            Budget::SLOWER_THAN_PASSED,
            limits.cpu_if_printing.as_secs()
        ),
        "after one item of a task has run out of time, or two have crashed or run out of memory, the \
         rest of that task isn't run"
            .to_owned(),
    ] {
        assert!(page.contains(&sentence), "the handout lacks: {sentence}");
    }
}

#[test]
fn the_starter_has_every_file_in_each_folder_and_no_marks() {
    let files = starter_files();
    let with_main = ASSIGNMENTS.map(|it| it.files.len() + it.given.len() + 1);
    let all: usize = with_main.iter().sum();
    assert_eq!(files.len(), 2 * all, "{files:?}");
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for mark in ["// solution", "// end solution", "// starter:"] {
            assert!(!text.contains(mark), "{mark} in {}", file.display());
        }
    }
}

#[test]
fn the_starter_is_formatted() {
    let check = Command::new("rustfmt")
        .args(["--check", "--edition", "2024"])
        .args(starter_files())
        .output();
    // If rustfmt isn't installed, the format can't be checked.
    if let Ok(output) = check {
        let differences = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{differences}");
    }
}
