//! Tests of `cargo author calibrate`: correct answers and mistakes are far enough from every
//! threshold.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Returns the committed table.
fn table() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../calibration.md");
    fs::read_to_string(path).expect("the table is committed")
}

#[test]
fn all_margins_are_wide_enough_for_one_seed() {
    let before = table();
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(["calibrate", "--check", "--seeds", "2..3", "--mistakes", "1"])
        .output()
        .expect("cargo builds the binary for this test");
    let summary = String::from_utf8_lossy(&output.stdout);
    let problems = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{problems}");
    assert!(summary.contains("seeds 1, "), "{summary}");
    assert_eq!(table(), before, "a check changes nothing");
}

#[test]
fn the_committed_table_covers_a_hundred_seeds() {
    let table = table();
    assert!(table.contains("of 100 seeds (0 to 99)"), "{table}");
}
