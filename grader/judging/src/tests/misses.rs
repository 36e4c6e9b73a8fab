//! Code that hits nothing, in each task of the practice exam.

#![allow(
    clippy::wildcard_enum_match_arm,
    reason = "only some kinds of answers are treated in a special way"
)]

use std::collections::BTreeMap;

use protocol::{Answer, ElementOutcome};

use super::EXAM;
use super::answers::Error;
use crate::assignment::{RAYS, TaskInfo};
use crate::exam::{ExamQuestion, Item, Key};
use crate::recognise::Observations;
use crate::signatures::NoAnswerReason;

/// Returns the correct answer. A question about a tree has no single correct answer, but such
/// questions don't matter here.
fn right_answer(question: &ExamQuestion) -> Answer {
    let answer = question.key.answer();
    answer.unwrap_or(Answer::Tree(ElementOutcome::Skipped))
}

/// Returns an item's correct answers.
fn right(item: &Item) -> Vec<Answer> {
    item.questions.iter().map(right_answer).collect()
}

/// Returns the answers of code that never reports a hit.
fn missed(item: &Item) -> Vec<Answer> {
    let miss = |right: Answer| match right {
        Answer::Spans(all) => Answer::Spans(vec![ElementOutcome::Value(None); all.len()]),
        Answer::Hits(all) => Answer::Hits(vec![ElementOutcome::Value(None); all.len()]),
        other => other,
    };
    right(item).into_iter().map(miss).collect()
}

fn is_picture(item: &Item) -> bool {
    let of_first_hits = |question: &ExamQuestion| matches!(question.key, Key::FirstHits { .. });
    item.questions.iter().all(of_first_hits)
}

/// Returns whether a task is reported to miss everything if one item has these answers (or no
/// answers, for the given reason) and all rays of the other items miss.
fn misses_everything(
    items: &[&Item],
    one: &Item,
    answers: Result<Vec<Answer>, NoAnswerReason>,
) -> bool {
    let mut observations = Observations::default();
    for item in items.iter().filter(|item| item.id != one.id) {
        observations.record(item, Ok(&missed(item)));
    }
    observations.record(one, answers.as_deref().map_err(|&why| why));
    observations.misses_everything(items.iter().copied())
}

#[test]
fn a_task_has_a_clue_for_code_that_hits_nothing_if_its_rays_can_hit_something() {
    for task in RAYS.tasks {
        let of_task = EXAM.items.iter().filter(|item| item.task == task.task());
        let items: Vec<&Item> = of_task.collect();
        let has_clue = task.clues.if_nothing_is_hit.is_some();
        let can_hit = items.iter().any(|item| right(item) != missed(item));
        assert_eq!(
            has_clue, can_hit,
            "{}: if_nothing_is_hit must be Some exactly if one of its rays hits",
            task.id
        );
        // One item of each kind is enough.
        let kind = |item: &Item| (right(item) != missed(item), is_picture(item));
        let kinds: BTreeMap<(bool, bool), &Item> =
            items.iter().map(|&item| (kind(item), item)).collect();
        for ((has_hits, _), item) in kinds {
            let missed = missed(item);
            let misses = |answers| misses_everything(&items, item, answers);
            assert_eq!(misses(Ok(missed.clone())), has_clue, "{}", item.id);
            assert_eq!(misses(Ok(right(item))), has_clue && !has_hits);
            // A missing answer could have been a hit. A picture, however, may lack an answer
            // because of another task.
            let unanswered = misses(Err(NoAnswerReason::Other));
            let is_missed = has_clue && (!has_hits || is_picture(item));
            assert_eq!(unanswered, is_missed, "{}", item.id);
            if has_hits {
                let mut panicked = missed;
                for answer in &mut panicked {
                    Error::Panicked.apply(answer, 0);
                }
                assert!(!misses(Ok(panicked)), "{}", item.id);
            }
        }
    }
}

#[test]
fn a_few_items_are_not_enough_to_say_that_everything_is_missed() {
    let of_boxes = EXAM.items.iter().filter(|item| item.task.id() == "bbox");
    let items: Vec<&Item> = of_boxes
        .filter(|item| missed(item) != right(item))
        .collect();
    let misses = |count: usize| misses_everything(&items[..count], items[0], Ok(missed(items[0])));
    assert_eq!([1, 2, 3, 4].map(misses), [false, false, true, true]);
}

#[test]
fn only_build_has_a_clue_for_a_recursion_that_does_not_end() {
    let overflow = |task: &&TaskInfo| task.clues.if_stack_overflows.is_some();
    let tasks: Vec<&str> = RAYS
        .tasks
        .iter()
        .filter(overflow)
        .map(|task| task.id)
        .collect();
    assert_eq!(tasks, ["build"]);
}
