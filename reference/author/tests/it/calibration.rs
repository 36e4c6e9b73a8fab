//! Tests of `cargo author calibrate`: correct answers and mistakes are far enough from every
//! threshold.

use crate::harness::{author_succeeds, text};

/// The committed table.
const TABLE: &str = "reference/calibration.md";

#[test]
fn all_margins_are_wide_enough_for_one_seed() {
    let before = text(TABLE);
    let one_seed = ["calibrate", "--check", "--seeds", "2..3"];
    let summary = author_succeeds(&[&one_seed[..], &["--mistakes", "1"]].concat());
    assert!(summary.contains("seeds 1, "), "{summary}");
    assert_eq!(text(TABLE), before, "a check changes nothing");
}

#[test]
fn the_committed_table_covers_thirty_seeds() {
    let table = text(TABLE);
    assert!(table.contains("of 30 seeds (0 to 29)"), "{table}");
}
