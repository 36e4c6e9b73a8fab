//! Tests of `cargo author mutants` and `cargo author systematic` with a fixed sample. Without `--fast`,
//! the commands grade all changes.

use std::process::Command;

#[test]
fn sampled_mutants_are_caught_or_equivalent() {
    assert_caught(&["mutants", "--fast", "--check"]);
}

#[test]
fn sampled_systematic_mistakes_are_caught_or_equivalent() {
    assert_caught(&["systematic", "--fast"]);
}

fn assert_caught(arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(arguments)
        .output()
        .expect("cargo builds the binary for this test");
    let summary = String::from_utf8_lossy(&output.stdout);
    let problems = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{summary}{problems}");
    assert!(summary.contains("selected: one in 8"), "{summary}");
    assert!(summary.trim_end().ends_with(", 0 survive"), "{summary}");
}
