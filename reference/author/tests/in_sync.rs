//! What is generated and committed is what would be generated now: through the real binary.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn author(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_author"))
        .args(arguments)
        .output()
        .expect("the binary was built for this test")
}

fn assert_in_sync(what: &str) {
    let output = author(&[what, "--check"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The starter's files in both of their places.
fn starter_files() -> Vec<PathBuf> {
    ["student/src", "grader/starter"]
        .iter()
        .flat_map(|place| fs::read_dir(root().join(place)).expect("the starter is written"))
        .map(|entry| entry.expect("a folder that can be listed").path())
        .collect()
}

#[test]
fn the_starter_is_in_sync() {
    assert_in_sync("starter");
}

#[test]
fn the_exams_are_in_sync() {
    assert_in_sync("exams");
}

#[test]
fn the_table_of_mistakes_is_in_sync() {
    assert_in_sync("mistakes");
}

#[test]
fn the_handout_is_in_sync_and_its_links_names_and_commands_exist() {
    assert_in_sync("handout");
}

#[test]
fn the_scenes_are_in_sync() {
    assert_in_sync("scenes");
}

#[test]
fn the_starter_has_nine_files_per_folder_and_no_marks() {
    let files = starter_files();
    assert_eq!(files.len(), 18, "{files:?}");
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
    // Where Rust was installed without rustfmt there is nothing to ask.
    if let Ok(output) = check {
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}");
    }
}
