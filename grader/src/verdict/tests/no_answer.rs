//! Items without answers: faults, items that were not run, and files that aren't compiled.

use crate::build::NotCompiled;
use crate::handed_out::LIGHT;
use crate::probe::{Crash, TimeLimit};
use crate::submission::TaskFileError;
use crate::verdict::messages::{file_line, file_message};

use super::*;

/// Every kind of fault, with its verdict.
fn faults() -> [(Fault, Verdict); 4] {
    [
        (Fault::TimedOut(TimeLimit::Cpu), Verdict::TimedOut),
        (Fault::OutOfMemory, Verdict::OutOfMemory),
        (Fault::Crashed(Crash::StackOverflow), Verdict::Crashed),
        (Fault::Protocol("no".to_owned()), Verdict::Protocol),
    ]
}

/// Every reason for not compiling a file.
fn reasons() -> [NotCompiled; 4] {
    [
        NotCompiled::Unreadable(TaskFileError::Missing),
        NotCompiled::MissingDeclaration("struct BBox"),
        NotCompiled::Error {
            text: "error: a\tmistake\u{1b}".to_owned(),
            line: Some(7),
        },
        NotCompiled::Compiler("error: no linker".to_owned()),
    ]
}

#[test]
fn a_fault_of_an_unknown_question_has_no_evidence() {
    let fault = Fault::OutOfMemory;
    let outcome = ItemOutcome::Fault {
        fault,
        culprit: None,
    };
    assert_eq!(without_answer(&outcome).evidence, None);
}

#[test]
fn an_item_that_was_not_run_says_why() {
    let stopped = faults().map(|(fault, verdict)| (NotRunReason::TaskStopped(fault), verdict));
    let others = [
        (NotRunReason::NeedsStoppedTask, Verdict::TimedOut),
        (NotRunReason::BudgetUsedUp, Verdict::TimedOut),
    ];
    let messages = stopped.into_iter().chain(others).map(|(why, verdict)| {
        let line = without_answer(&ItemOutcome::NotRun(why));
        assert_eq!((line.points, line.verdict), (0, verdict));
        assert_eq!(line.section, Some(Section::new("boxes.md#a-heading")));
        line.message
    });
    insta::assert_snapshot!(messages.collect::<Vec<_>>().join("\n"), @r"
    not run because another item in this task took too long
    not run because two other items in this task crashed
    not run because two other items in this task crashed
    not run because two other items in this task crashed
    not run because a task that this item depends on was stopped early
    not run because earlier items used up the submission's time
    ");
}

#[test]
fn a_file_that_is_not_compiled_says_why_in_its_items_and_in_full() {
    let items = reasons().map(|why| {
        let line = without_answer(&ItemOutcome::NotCompiled(&why));
        assert_eq!((line.points, line.verdict), (0, Verdict::NotCompiled));
        line.message
    });
    insta::assert_snapshot!(items.join("\n"), @r"
    bbox.rs is missing
    bbox.rs has no `struct BBox`, which other files use: put it back, or restore the original file with `cargo grade --reset bbox.rs`
    bbox.rs does not compile
    the submission does not compile
    ");
    let files = reasons().map(|why| file_message("bbox.rs", &why));
    insta::assert_snapshot!(files.join("\n"), @r"
    bbox.rs is missing
    bbox.rs has no `struct BBox`, which other files use: put it back, or restore the original file with `cargo grade --reset bbox.rs`
    error: a    mistake\u{1b}
    error: no linker
    ");
    let lines = reasons().map(|why| file_line(&why));
    assert_eq!(lines, [None, None, Some(7), None]);
}

#[test]
fn a_section_on_a_panic_fits_its_kind_and_a_time_out_leads_to_the_chapter() {
    let read = |outcome: &ItemOutcome| {
        let line = item_score(&item("path.bounces", vec![boxes(2)]), outcome, &LIGHT);
        line.where_to_read().map(Section::to_string)
    };
    let panics = |message: &str| {
        let panicked = panicked(Credit::NONE, message, "path.rs:9:9");
        read(&ItemOutcome::answered(vec![panicked]))
    };
    let unwrap = panics("called `Option::unwrap()` on a `None` value");
    let section = "light/paths.md#a-surface-that-scatters-nothing";
    assert_eq!(unwrap.as_deref(), Some(section));
    assert_eq!(
        panics("attempt to divide by zero").as_deref(),
        Some("light/paths.md")
    );
    let endless = ItemOutcome::Fault {
        fault: Fault::TimedOut(TimeLimit::Cpu),
        culprit: None,
    };
    assert_eq!(read(&endless).as_deref(), Some("light/paths.md"));
}

#[test]
fn a_crash_leads_to_a_section_about_crashes_or_else_to_the_tasks_chapter() {
    let read = |id: &str, section: &str, outcome: &ItemOutcome| {
        let mut item = item(id, vec![boxes(2)]);
        item.section = Some(Section::new(section));
        let line = item_score(&item, outcome, &RAYS);
        line.where_to_read().map(Section::to_string)
    };
    let panics = ItemOutcome::answered(vec![panicked(
        Credit::NONE,
        "index out of bounds",
        "bvh.rs:9:9",
    )]);
    let overflows = ItemOutcome::Fault {
        fault: Fault::Crashed(Crash::StackOverflow),
        culprit: None,
    };
    let picture = "grading.md#reading-a-wrong-picture";
    let coincident = "building.md#when-all-centres-coincide";
    for (id, section, outcome, expected) in [
        (
            "traverse.deep",
            "traversal.md#deep-trees",
            &panics,
            "traversal.md#deep-trees",
        ),
        (
            "traverse.ranges",
            "traversal.md#the-algorithm",
            &panics,
            "traversal.md",
        ),
        ("traverse.picture", picture, &panics, "traversal.md"),
        ("build.coincident", coincident, &panics, coincident),
        ("build.coincident", coincident, &overflows, coincident),
        (
            "build.contains",
            "building.md#start-each-box-empty",
            &overflows,
            "building.md#a-side-without-primitives",
        ),
    ] {
        assert_eq!(
            read(id, section, outcome).as_deref(),
            Some(expected),
            "{id}"
        );
    }
    let mut unwritten = item("traverse.picture", vec![boxes(2)]);
    unwritten.section = Some(Section::new(picture));
    let line = unwritten_score(&unwritten, "bvh.rs", 9, &RAYS);
    assert_eq!(line.section, Some(Section::new("traversal.md")));
}
