//! The recipe for GNU parallel, run with GNU parallel.

use std::process::Command;

use test_support::programs::make_executable;

use super::{ITEMS, is_installed, recipe_command};
use crate::harness::{TestClass, exit_code_and_stderr, successful_stdout};

/// A replacement for the binary that is killed while grading the second shard, as many times as the
/// variable DEATHS specifies.
const DYING: &str = r#"#!/bin/bash
if [[ "$*" == *"--shard 2/2"* && $(cat "$OUT/deaths" 2>/dev/null | wc -l) -lt "$DEATHS" ]]; then
    echo died >>"$OUT/deaths"
    kill -9 $$
fi
exec "$REAL_CLASS" "$@"
"#;

#[test]
fn grades_a_dead_part_again_and_merges() {
    let version = Command::new("parallel").arg("--version").output();
    let is_gnu =
        version.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("GNU"));
    if !is_installed("GNU parallel", is_gnu) {
        return;
    }
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    let dying = class.write_beside("dying", DYING);
    make_executable(dying.as_ref());
    let run = |deaths: &str| {
        recipe_command("parallel.sh", &class, &exam, &class.out())
            .env("SHARDS", "2")
            .env("CORES", "1")
            .env("RETRIES", "1")
            .env("CLASS", &dying)
            .env("REAL_CLASS", env!("CARGO_BIN_EXE_class"))
            .env("DEATHS", deaths)
            .output()
            .unwrap()
    };
    // The second shard's run dies twice but is only retried once.
    let (code, error) = exit_code_and_stderr(&run("2"));
    assert_eq!(code, 3, "{error}");
    assert!(error.contains("some parts were not graded"), "{error}");
    assert!(!class.out().join("grades.csv").exists());
    // Now the run dies once more.
    successful_stdout(&run("3"));
    assert_eq!(class.read("deaths").lines().count(), 3);
    assert_eq!(class.read("grades.csv").lines().count(), 4);
}
