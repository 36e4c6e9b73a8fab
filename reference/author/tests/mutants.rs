//! A test of `cargo author mutants` with a fixed sample. Without `--fast`, the command grades all mutants.

use std::process::Command;

#[test]
fn sampled_mutants_are_caught_or_equivalent() {
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(["mutants", "--fast"])
        .output()
        .expect("cargo builds the binary for this test");
    let summary = String::from_utf8_lossy(&output.stdout);
    let problems = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{summary}{problems}");
    assert!(summary.contains("selected: one in 8"), "{summary}");
    assert!(summary.trim_end().ends_with(", 0 survive"), "{summary}");
}
