//! Tests for scores, and a small exam for other tests.

pub mod small_exam;

use super::*;
use crate::handed_out::RAYS;

#[test]
fn a_panic_is_located_in_task_files_only() {
    let line = |location: &str| CodeLocation::from_panic(location, &RAYS);
    let found = line("sphere.rs:34:9").unwrap();
    assert_eq!((found.file.as_str(), found.line), ("sphere.rs", 34));
    for elsewhere in ["world.rs:34:9", "sphere.rs", "sphere.rs:x:9", ""] {
        assert_eq!(line(elsewhere), None, "{elsewhere}");
    }
}

/// Every verdict.
pub fn verdicts() -> [Verdict; 12] {
    let by = "bbox.flat".to_owned();
    [
        Verdict::Pass,
        Verdict::Partial,
        Verdict::Wrong,
        Verdict::Panicked,
        Verdict::Unimplemented,
        Verdict::TimedOut,
        Verdict::OutOfMemory,
        Verdict::Crashed,
        Verdict::Protocol,
        Verdict::NotCompiled,
        Verdict::Blocked { by },
        Verdict::Pending,
    ]
}

#[test]
fn every_verdict_has_a_label_and_a_kind() {
    let lines = verdicts().map(|verdict| format!("{}: {:?}", verdict.label(), verdict.kind()));
    insta::assert_snapshot!(lines.join("\n"), @r"
    passed: Passed
    partial: Failed
    wrong: Failed
    panicked: Failed
    not written yet: Unwritten
    out of time: NoAnswer
    out of memory: NoAnswer
    crashed: NoAnswer
    no answer: NoAnswer
    not compiled: NotCompiled
    blocked: Blocked
    not graded yet: Pending
    ");
}

#[test]
fn published_schema_matches_the_types() {
    let schema = schemars::schema_for!(Score);
    let schema = format!("{:#}\n", schema.as_value());
    if std::env::var_os("INSTA_UPDATE").is_some_and(|what| what == "always") {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/score/score.schema.json");
        std::fs::write(path, &schema).unwrap();
    }
    assert_eq!(
        PUBLISHED_SCHEMA, schema,
        "`INSTA_UPDATE=always cargo test -p grader --lib schema` updates it"
    );
}
