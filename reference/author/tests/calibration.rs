//! Right answers and mistakes keep their distance from every threshold: through the real binary.

use std::fs;
use std::path::Path;
use std::process::Command;

/// The table that is committed.
fn table() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../calibration.md");
    fs::read_to_string(path).expect("it was measured")
}

#[test]
fn all_margins_are_wide_enough_for_one_seed() {
    let before = table();
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(["calibrate", "--check", "--seeds", "2..3", "--mistakes", "1"])
        .output()
        .expect("the binary was built for this test");
    let said = String::from_utf8_lossy(&output.stdout);
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaints}");
    assert!(said.contains("seeds 1, "), "{said}");
    assert_eq!(table(), before, "a check changes nothing");
}

#[test]
fn the_committed_table_covers_200_seeds() {
    let table = table();
    assert!(table.contains("of 200 seeds (0 to 199)"), "{table}");
}
