//! Tests of the scores of items, with small items and outcomes made by hand.

use judging::exam::{ExamQuestion, Key};
use protocol::{Panic, Question};

use super::*;
use crate::handed_out::RAYS;
use crate::probe::{Crash, TimeLimit};
use crate::small_exam::{boxes, exam, item, pending};
use crate::submission::TaskFileError;

fn right() -> Judgement {
    Judgement {
        credit: Credit::FULL,
        failure: None,
    }
}

fn failed(credit: Credit, element: usize, kind: FailureKind) -> Judgement {
    Judgement {
        credit,
        failure: Some(Failure {
            element,
            kind,
            count: None,
        }),
    }
}

/// Returns a judgement by which the interval is wrong at this element, and `count` says how many
/// elements are wrong.
fn wrong(credit: Credit, element: usize, count: Option<(usize, usize)>) -> Judgement {
    Judgement {
        credit,
        failure: Some(Failure {
            element,
            kind: FailureKind::Wrong {
                what: "interval".to_owned(),
                got: "None".to_owned(),
                wanted: "[0, 1]".to_owned(),
            },
            count,
        }),
    }
}

fn panicked(credit: Credit, message: &str, location: &str) -> Judgement {
    let panic = Panic {
        message: message.to_owned(),
        location: location.to_owned(),
    };
    failed(credit, 0, FailureKind::Panicked(panic))
}

/// Returns the score of an item that has one of these questions for each judgement.
fn answered(questions: Vec<ExamQuestion>, judgements: Vec<Judgement>) -> ItemScore {
    assert_eq!(questions.len(), judgements.len());
    let outcome = ItemOutcome::answered(judgements);
    item_score(&item("bbox.through", questions), &outcome, &RAYS)
}

/// Returns the score of an item that asks two questions and has this outcome.
fn without_answer(outcome: &ItemOutcome) -> ItemScore {
    item_score(&item("bbox.through", vec![boxes(2)]), outcome, &RAYS)
}

fn fault(fault: Fault) -> ItemOutcome<'static> {
    let culprit = None;
    ItemOutcome::Fault { fault, culprit }
}

/// Every kind of fault, with its verdict.
fn faults() -> [(Fault, Verdict); 4] {
    [
        (Fault::TimedOut(TimeLimit::Cpu), Verdict::TimedOut),
        (Fault::OutOfMemory, Verdict::OutOfMemory),
        (Fault::Crashed(Crash::StackOverflow), Verdict::Crashed),
        (Fault::Protocol("no".to_owned()), Verdict::Protocol),
    ]
}

/// Every reason why a file is not compiled.
fn reasons() -> [NotCompiled; 4] {
    [
        NotCompiled::Unreadable(TaskFileError::Missing("bbox.rs")),
        NotCompiled::MissingDeclaration("struct BBox"),
        NotCompiled::Error {
            text: "error: a\tmistake\u{1b}".to_owned(),
            line: Some(7),
        },
        NotCompiled::Compiler("error: no linker".to_owned()),
    ]
}

#[test]
fn a_score_begins_with_the_items_of_each_task_in_lecture_order() {
    // Without any item of the first task.
    let exam = exam(&["sphere.normal", "triangle.uv", "sphere.uv"]);
    let score = pending(&exam);
    let tasks = score.tasks.iter().map(|task| {
        let ids: Vec<&str> = task.items.iter().map(|item| item.id.as_str()).collect();
        (task.title.as_str(), task.points, task.max_points, ids)
    });
    assert_eq!(
        tasks.collect::<Vec<_>>(),
        [
            ("Task 2: triangles", 0, 4, vec!["triangle.uv"]),
            ("Task 2: spheres", 0, 8, vec!["sphere.normal", "sphere.uv"]),
        ]
    );
    assert_eq!(score.tasks[0].chapter, Some(Section::new("boxes.md")));
    assert_eq!((score.points, score.max_points), (0, 12));
    assert_eq!(
        (score.submission.as_str(), score.complete),
        ("alice", false)
    );
    assert_eq!(score.exam.id, "small");
    assert!(score.items().all(|item| item.verdict == Verdict::Pending));
}

#[test]
fn an_item_with_right_answers_has_all_points_and_nothing_to_say() {
    let line = answered(vec![boxes(2), boxes(1)], vec![right(), right()]);
    assert_eq!(
        line,
        ItemScore {
            id: "bbox.through".to_owned(),
            title: "title of bbox.through".to_owned(),
            points: 4,
            max_points: 4,
            verdict: Verdict::Pass,
            message: String::new(),
            at: None,
            look: None,
            clue: None,
            section: None,
            hints: Vec::new(),
            evidence: None,
            carried_forward: false,
            pictures: Vec::new(),
            staff: None,
        }
    );
}

#[test]
fn a_wrong_answer_is_shown_with_its_question_and_its_number_in_the_item() {
    let judgements = vec![right(), wrong(Credit::NONE, 1, None)];
    let line = answered(vec![boxes(3), boxes(2)], judgements);
    assert_eq!((line.points, line.verdict), (0, Verdict::Wrong));
    assert_eq!(line.message, "wrong: interval");
    assert_eq!(line.look.as_deref(), Some("look here"));
    assert_eq!(line.section, Some(Section::new("boxes.md#a-heading")));
    assert_eq!((line.at, line.clue), (None, None));
    let evidence = line.evidence.unwrap();
    assert_eq!(evidence.number, 5);
    assert!(evidence.asked.contains("from (1, 0, 0)"), "{evidence:?}");
    assert_eq!(
        (evidence.got.as_str(), evidence.wanted.as_str()),
        ("None", "[0, 1]")
    );
}

#[test]
fn an_item_has_the_credit_of_its_worst_question() {
    let judgements = vec![
        wrong(Credit::HALF, 0, None),
        right(),
        wrong(Credit::by_count(8, 40), 1, None),
    ];
    let line = answered(vec![boxes(1), boxes(2), boxes(2)], judgements);
    assert_eq!((line.points, line.verdict), (1, Verdict::Partial));
    assert_eq!(line.evidence.unwrap().number, 5);
}

#[test]
fn the_number_of_wrong_answers_covers_all_questions_of_the_item() {
    let message = |questions, judgements| answered(questions, judgements).message;
    assert_eq!(
        message(vec![boxes(1)], vec![wrong(Credit::NONE, 0, Some((1, 1)))]),
        "wrong: interval",
        "there is only one"
    );
    assert_eq!(
        message(
            vec![boxes(2), boxes(3)],
            vec![right(), wrong(Credit::NONE, 1, Some((1, 3)))]
        ),
        "1 of 5 answers is wrong: interval"
    );
    assert_eq!(
        message(
            vec![boxes(2), boxes(3)],
            vec![
                wrong(Credit::NONE, 0, Some((2, 2))),
                wrong(Credit::NONE, 1, Some((1, 3)))
            ]
        ),
        "3 of 5 answers are wrong; in #1: interval"
    );
    assert_eq!(
        message(
            vec![boxes(2), boxes(3)],
            vec![
                wrong(Credit::NONE, 1, Some((1, 2))),
                wrong(Credit::NONE, 1, None)
            ]
        ),
        "2 of 5 answers are wrong; in #2: interval",
        "a question without a count has one wrong answer"
    );
}

#[test]
fn the_pixels_of_a_path_traced_picture_are_counted_by_themselves() {
    let picture = ExamQuestion::new(
        Question::Radiance {
            scene: String::new(),
            film: glam::UVec2::new(4, 2),
            samples: 1,
            bounces: 1,
            seed: 0,
        },
        Key::Radiance {
            pixels: Vec::new(),
            max_wrong_pixels: 0,
        },
    );
    let judgements = vec![
        wrong(Credit::NONE, 6, Some((3, 8))),
        wrong(Credit::HALF, 0, Some((2, 2))),
    ];
    let line = answered(vec![picture, boxes(2)], judgements);
    assert_eq!(line.message, "3 of 8 answers are wrong; in #1: interval");
    assert_eq!(line.evidence.unwrap().number, 1);
}

#[test]
fn a_panic_is_shown_with_its_line_and_a_clue() {
    let message = "index out of bounds: the len is 2\u{1b} but the index is 2";
    let line = answered(
        vec![boxes(1)],
        vec![panicked(Credit::NONE, message, "bbox.rs:34:9")],
    );
    assert_eq!((line.points, line.verdict), (0, Verdict::Panicked));
    assert_eq!(
        line.message,
        "panicked at bbox.rs:34:9: index out of bounds: the len is 2\\u{1b} but the index is 2"
    );
    let at = line.at.unwrap();
    assert_eq!((at.file.as_str(), at.line), ("bbox.rs", 34));
    assert!(line.clue.unwrap().starts_with("Read the index"));
    assert_eq!(line.look.as_deref(), Some("look here"));
    let evidence = line.evidence.unwrap();
    assert_eq!(
        (
            evidence.number,
            evidence.got.as_str(),
            evidence.wanted.as_str()
        ),
        (1, "a panic", "an answer")
    );
}

#[test]
fn a_panic_in_a_picture_that_is_partly_right_is_partial() {
    let judgement = panicked(Credit::HALF, "oh", "world.rs:3:1");
    let line = answered(vec![boxes(1)], vec![judgement]);
    assert_eq!((line.points, line.verdict), (2, Verdict::Partial));
    assert_eq!((line.at, line.clue), (None, None), "in a given file");
}

#[test]
fn code_that_is_not_written_yet_needs_its_chapter_and_no_evidence() {
    let line = answered(
        vec![boxes(1)],
        vec![panicked(
            Credit::NONE,
            "not yet implemented: task 3",
            "bbox.rs:12:9",
        )],
    );
    assert_eq!((line.points, line.verdict), (0, Verdict::Unimplemented));
    assert_eq!(line.message, "bbox.rs:12:9 still contains `todo!`");
    assert_eq!(line.at.unwrap().line, 12);
    assert_eq!((line.look, line.clue, line.evidence), (None, None, None));
    assert_eq!(line.section, Some(Section::new("boxes.md")));
}

#[test]
fn an_answer_of_the_wrong_kind_is_no_evidence() {
    let kind = FailureKind::Protocol("too short".to_owned());
    let line = answered(vec![boxes(1)], vec![failed(Credit::NONE, 0, kind)]);
    assert_eq!((line.points, line.verdict), (0, Verdict::Protocol));
    assert_eq!(
        line.message,
        "the program sent an invalid answer: too short"
    );
    assert_eq!(line.evidence, None);
}

#[test]
fn an_item_without_judgements_earns_nothing() {
    let line = answered(Vec::new(), Vec::new());
    assert_eq!((line.points, line.verdict), (0, Verdict::Protocol));
}

#[test]
fn an_answer_that_is_right_alone_points_to_kept_state() {
    let outcome = ItemOutcome::Answered {
        judgements: vec![wrong(Credit::NONE, 0, None)],
        right_alone: true,
    };
    let line = item_score(&item("bbox.through", vec![boxes(1)]), &outcome, &RAYS);
    assert_eq!(line.clue.as_deref(), Some(clue::KEPT_STATE));
}

#[test]
fn a_fault_says_what_happened_and_asks_the_question_that_caused_it() {
    for (fault, verdict) in faults() {
        let outcome = ItemOutcome::Fault {
            fault: fault.clone(),
            culprit: Some((0, 1)),
        };
        let line = without_answer(&outcome);
        assert_eq!((line.points, line.verdict), (0, verdict));
        assert_eq!(line.message, fault.to_string());
        let task = RAYS.assignment.find("bbox").unwrap();
        assert_eq!(line.clue, Some(clue::of_fault(&fault, task)));
        assert_eq!(line.section, Some(Section::new("boxes.md#a-heading")));
        let evidence = line.evidence.unwrap();
        assert_eq!(evidence.number, 2);
        assert!(evidence.asked.contains("from (1, 0, 0)"), "{evidence:?}");
        assert_eq!(
            (evidence.got.as_str(), evidence.wanted.as_str()),
            ("no answer", "an answer")
        );
    }
    let line = without_answer(&fault(Fault::OutOfMemory));
    assert_eq!(line.evidence, None, "the question is not known");
}

#[test]
fn an_item_that_was_not_run_says_why() {
    let stopped = faults().map(|(fault, verdict)| (NotRun::TaskStopped(fault), verdict));
    let others = [
        (NotRun::NeedsStoppedTask, Verdict::TimedOut),
        (NotRun::BudgetUsedUp, Verdict::TimedOut),
    ];
    let messages = stopped.into_iter().chain(others).map(|(why, verdict)| {
        let line = without_answer(&ItemOutcome::NotRun(why));
        assert_eq!((line.points, line.verdict), (0, verdict));
        assert_eq!(line.section, Some(Section::new("boxes.md#a-heading")));
        line.message
    });
    insta::assert_snapshot!(messages.collect::<Vec<_>>().join("\n"), @r"
    not run, because another item of this task took too long
    not run, because two other items of this task crashed
    not run, because two other items of this task crashed
    not run, because two other items of this task crashed
    not run, because a task that it depends on was stopped
    not run, because the items before it have used up the time of the whole submission
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
    bbox.rs has no `struct BBox`, which other files use
    bbox.rs does not compile
    the submission does not compile
    ");
    let files = reasons().map(|why| file_message("bbox.rs", &why));
    insta::assert_snapshot!(files.join("\n"), @r"
    bbox.rs is missing
    bbox.rs has no `struct BBox`, which other files use
    error: a    mistake\u{1b}
    error: no linker
    ");
    let lines = reasons().map(|why| file_line(&why));
    assert_eq!(lines, [None, None, Some(7), None]);
}

#[test]
fn the_first_item_that_earned_nothing_blocks_those_that_depend_on_it() {
    let ids = [
        "triangle.inside",
        "bbox.through",
        "bbox.flat",
        "traverse.root",
    ];
    let mut score = pending(&exam(&ids));
    let mut dependent = item("traverse.root", vec![boxes(1)]);
    dependent.needs = ["triangle.inside", "bbox.through", "bbox.flat"]
        .map(str::to_owned)
        .to_vec();
    let mut earn = |id: &str, points| {
        let mut items = score.tasks.iter_mut().flat_map(|task| &mut task.items);
        items.find(|item| item.id == id).unwrap().points = points;
        blocking_item(&dependent, &score).map(|blocking| (blocking.id, blocking.task.to_string()))
    };
    // Its own item has no points, either, and does not block itself.
    assert_eq!(
        earn("triangle.inside", 1),
        Some(("bbox.through", "bbox".to_owned()))
    );
    assert_eq!(
        earn("bbox.through", 4),
        Some(("bbox.flat", "bbox".to_owned()))
    );
    assert_eq!(earn("bbox.flat", 1), None);
    assert_eq!(
        earn("triangle.inside", 0),
        Some(("triangle.inside", "triangle".to_owned()))
    );
}

/// Returns an item's score that has a value in every field.
fn full_score() -> ItemScore {
    let judgement = panicked(Credit::NONE, "attempt to add with overflow", "bbox.rs:34:9");
    let line = answered(vec![boxes(1)], vec![judgement]);
    assert!(line.at.is_some() && line.look.is_some() && line.clue.is_some());
    assert!(line.section.is_some() && line.evidence.is_some());
    line
}

#[test]
fn a_blocked_item_says_only_what_to_fix_first() {
    let line = full_score();
    let (id, title) = (line.id.clone(), line.title.clone());
    let blocked = blocked_score("triangle.inside", line);
    assert_eq!(
        blocked,
        ItemScore {
            id,
            title,
            points: 0,
            max_points: 4,
            verdict: Verdict::Blocked {
                by: "triangle.inside".to_owned()
            },
            message: "depends on triangle.inside: fix that first".to_owned(),
            at: None,
            look: None,
            clue: None,
            section: None,
            hints: Vec::new(),
            evidence: None,
            carried_forward: false,
            pictures: Vec::new(),
            staff: None,
        }
    );
}

#[test]
fn an_item_that_earned_points_in_spite_of_a_failed_one_is_not_blocked() {
    for points in [1, 4] {
        let line = ItemScore {
            points,
            ..full_score()
        };
        assert_eq!(blocked_score("triangle.inside", line.clone()), line);
    }
    let line = without_answer(&ItemOutcome::Pending);
    assert_eq!(blocked_score("triangle.inside", line.clone()), line);
}

fn mistake(id: &str, section: Option<&str>) -> KnownMistake {
    KnownMistake {
        id: id.to_owned(),
        nudge: format!("Is it {id}?"),
        hint: format!("It is {id}."),
        section: section.map(Section::new),
    }
}

#[test]
fn every_mistake_that_explains_the_answers_gives_a_hint_and_the_first_its_section() {
    let hinted = |mistakes: &[KnownMistake]| {
        let mut line = full_score();
        add_hints(&mut line, &mistakes.iter().collect::<Vec<_>>());
        line
    };
    let known = [
        mistake("bbox.swap", Some("boxes.md#swap")),
        mistake("bbox.flat", Some("boxes.md#flat")),
    ];
    let line = hinted(&known);
    let hint = |nudge: &str, hint: &str| Hint {
        nudge: nudge.to_owned(),
        hint: hint.to_owned(),
    };
    assert_eq!(
        line.hints,
        [
            hint("Is it bbox.swap?", "It is bbox.swap."),
            hint("Is it bbox.flat?", "It is bbox.flat.")
        ]
    );
    assert_eq!(line.section, Some(Section::new("boxes.md#swap")));
    assert_eq!(
        line.staff.as_deref(),
        Some("answers like bbox.swap or bbox.flat")
    );

    let line = hinted(&[mistake("bbox.swap", None)]);
    assert_eq!(line.section, full_score().section);
    assert_eq!(line.staff.as_deref(), Some("answers like bbox.swap"));

    assert_eq!(hinted(&[]), full_score());
}

#[test]
fn a_substituted_score_counts_and_compares_itself_with_the_items_own() {
    let passed = answered(vec![boxes(1)], vec![right()]);
    let failed = answered(vec![boxes(1)], vec![wrong(Credit::NONE, 0, None)]);
    let message = |own: &ItemScore, substituted: &ItemScore| {
        let score = substituted_score("triangle.inside", own, substituted.clone());
        let message = score.message.clone();
        let expected = ItemScore {
            message: message.clone(),
            carried_forward: true,
            ..substituted.clone()
        };
        assert_eq!(score, expected);
        message
    };
    assert_eq!(message(&passed, &passed), "");
    let others = [(&failed, &passed), (&passed, &failed), (&failed, &failed)];
    let messages = others.map(|(own, substituted)| message(own, substituted));
    insta::assert_snapshot!(messages.join("\n"), @r"
    wrong only because triangle.inside failed: correct with the reference's other files
    wrong: interval; passes only because the mistake in triangle.inside cancels this one, so it is graded with the reference's other files
    wrong: interval; graded with the reference's other files, because triangle.inside failed
    ");
}
