//! A test of `cargo author mutants` with a fixed sample. Without `--fast`, the command grades all mutants.

use crate::harness::author_succeeds;

#[test]
fn sampled_mutants_are_caught_or_equivalent() {
    let summary = author_succeeds(&["mutants", "--fast"]);
    assert!(summary.contains("selected: one in 8"), "{summary}");
    assert!(summary.trim_end().ends_with(", 0 survive"), "{summary}");
}
