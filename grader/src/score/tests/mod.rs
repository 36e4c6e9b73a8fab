//! Tests of scores, and a small exam for other tests.

pub mod small_exam;

use super::*;
use crate::handed_out::RAYS;
use small_exam::{exam, pending};

/// Returns the score of an exam with these items.
fn score(ids: &[&str]) -> Score {
    pending(&exam(ids))
}

fn item(id: &str) -> ItemScore {
    score(&[id]).tasks.remove(0).items.remove(0)
}

#[test]
fn an_items_score_replaces_the_one_with_its_id_and_counts() {
    let mut score = score(&["sphere.uv", "sphere.miss", "bbox.flat"]);
    for (id, points) in [("sphere.miss", 3), ("bbox.flat", 2), ("bbox.none", 9)] {
        score.record(ItemScore { points, ..item(id) });
    }
    score.update_totals();
    let items = score.items().map(|item| (item.id.as_str(), item.points));
    let expected = [("sphere.uv", 0), ("sphere.miss", 3), ("bbox.flat", 2)];
    assert!(items.eq(expected));
    let tasks: Vec<u32> = score.tasks.iter().map(|task| task.points).collect();
    assert_eq!((tasks, score.points), (vec![3, 2], 5));
    // Totals are computed anew, not added to.
    score.update_totals();
    assert_eq!(score.points, 5);
}

#[test]
fn a_panic_is_located_in_task_files_only() {
    let line = |location: &str| CodeLocation::from_panic(location, &RAYS);
    let found = line("sphere.rs:34:9").unwrap();
    assert_eq!((found.file.as_str(), found.line), ("sphere.rs", 34));
    for elsewhere in ["world.rs:34:9", "sphere.rs", "sphere.rs:x:9", ""] {
        assert_eq!(line(elsewhere), None, "{elsewhere}");
    }
}

#[test]
fn what_a_failure_tells_is_shown_before_what_the_item_tells() {
    let mut item = item("sphere.uv");
    assert_eq!(item.where_to_look(), None);
    item.look = Some("look".to_owned());
    assert_eq!(item.where_to_look(), Some(&"look".to_owned()));
    item.clue = Some("clue".to_owned());
    assert_eq!(item.where_to_look(), Some(&"clue".to_owned()));
}

#[test]
fn an_item_is_run_again_by_its_question_or_with_its_task() {
    let command = RerunCommand::default();
    let mut item = item("sphere.uv");
    assert_eq!(item.rerun_command(&command), "cargo grade --task sphere");
    assert_eq!(item.view_command(&command), None);
    let [asked, got, wanted] = [const { String::new() }; 3];
    item.evidence = Some(Evidence {
        number: 7,
        asked,
        got,
        wanted,
        can_be_shown: true,
    });
    let (rerun, view) = (item.rerun_command(&command), item.view_command(&command));
    assert_eq!(rerun, "cargo grade --replay sphere.uv#7");
    assert_eq!(view.as_deref(), Some("cargo view --item sphere.uv#7"));
    if let Some(evidence) = &mut item.evidence {
        evidence.can_be_shown = false;
    }
    assert_eq!(item.view_command(&command), None);
}

#[test]
fn a_score_file_is_json_that_ends_with_a_line_break() {
    let text = score(&["sphere.uv"]).to_json();
    let file: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(file["tasks"][0]["items"][0]["id"], "sphere.uv");
    assert!(text.ends_with("}\n"));
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
