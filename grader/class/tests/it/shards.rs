//! Classes that are graded in shards, and properties of merged classes.

use std::path::{Path, PathBuf};

use proptest::prelude::*;
use tempfile::TempDir;

use crate::harness::{TestClass, assert_contains, comparable_files, merge, successful_stdout};

use crate::stored_class::{stored_class, write_shard, write_shards};

const ITEMS: [&str; 1] = ["camera.offset"];

#[test]
fn merged_shards_equal_an_unsharded_run() {
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    let policy = class
        .lists(&[("policy", "[points]\nout_of = 7\n")])
        .remove(0);
    class.graded(&exam, &[&policy]);
    let shards = ["1/2", "2/2"].map(|which| {
        let out = class.path_beside(&format!("shard-{}", which.replace('/', "-")));
        let mut command = class.command_into(&out, &exam, &["--shard", which, &policy]);
        successful_stdout(&command.output().unwrap());
        out
    });
    let out = class.path_beside("merged");
    merge(&shards, &out);
    // The merge takes the policy from the shards.
    assert_eq!(comparable_files(&out), comparable_files(&class.out()));
    assert!(class.read("grades.csv").contains("graded,7,"));
}

#[test]
fn an_estimate_grades_a_few_submissions_and_keeps_their_results() {
    let class = TestClass::of_three()
        .with_reference("dora")
        .with_reference("eve");
    let exam = class.small_exam(&ITEMS);
    let estimate = || class.graded(&exam, &["--estimate", "--jobs", "1"]);
    let text = estimate();
    let expected = [
        "estimate from 2 submissions",
        "2 more submissions, 1 at a time",
    ];
    assert_contains(&text, &expected);
    assert!(
        text.contains("64 machines like this") && text.contains("core-hours"),
        "{text}"
    );
    assert!(!class.out().join("grades.csv").exists());
    let text = estimate();
    assert!(text.contains("0 more submissions"), "{text}");
    let text = estimate();
    assert!(text.contains("nothing to estimate"), "{text}");
    let graded = class.grade(&exam, &[]);
    let lines = String::from_utf8_lossy(&graded.stderr);
    assert!(!lines.contains("dora: "), "all results were kept: {lines}");
    assert!(successful_stdout(&graded).contains("4 graded"));
}

/// Merges shards. Returns the standard output without the folder's path.
fn merged(shards: &[PathBuf], out: &Path) -> String {
    merge(shards, out).replace(out.to_str().unwrap(), "OUT")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// With more shards than submissions, some shards are empty. A shard may also contain the
    /// results of somebody who has left the class.
    #[test]
    fn shards_in_any_number_and_order_are_merged_to_the_same_files(
        class in stored_class(),
        of in 1..=5usize,
        order in Just(Vec::from_iter(0..5)).prop_shuffle(),
        stale: bool,
    ) {
        let root = TempDir::new().unwrap();
        let [graded, whole, out] = ["graded", "whole", "parts"].map(|name| root.path().join(name));
        write_shard(&graded, &class, None, false);
        let text = merged(&[graded], &whole);
        let shards = write_shards(root.path(), &class, of, stale);
        let order = order.into_iter().filter(|index| *index < of);
        let shuffled: Vec<PathBuf> = order.map(|index| shards[index].clone()).collect();
        let text_of_parts = merged(&shuffled, &out);
        let (parts, whole) = (comparable_files(&out), comparable_files(&whole));
        let all = parts.keys().chain(whole.keys());
        let mut differ: Vec<&PathBuf> = all.filter(|file| parts.get(*file) != whole.get(*file)).collect();
        if stale {
            // The page and the output list the people who have left.
            differ.retain(|file| *file != "class.html");
            prop_assert!(text_of_parts.contains("no longer in the input"), "{}", text_of_parts);
        } else {
            prop_assert_eq!(text_of_parts, text);
        }
        prop_assert_eq!(differ, Vec::<&PathBuf>::new());
    }
}
