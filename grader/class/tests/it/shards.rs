//! Classes that are graded in shards.

use crate::harness::{TestClass, assert_contains, comparable_files, merge, successful_stdout};

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
    assert_contains(
        &text,
        &[
            "estimate from 2 submissions",
            "2 more submissions, 1 at a time",
        ],
    );
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
    assert!(!lines.contains(" of "), "all results were kept: {lines}");
    assert!(successful_stdout(&graded).contains("4 graded"));
}
