//! Tests for the scores of items, with small handmade items and outcomes.

use judging::exam::{ExamQuestion, Key};
use judging::judge::{Credit, Failure, FailureKind, Judgement};
use protocol::{Panic, Question};

use super::*;
use crate::handed_out::RAYS;
use crate::score::tests::small_exam::{boxes, exam, item, pending};

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

/// Returns a judgement that the interval is wrong at this element. `count` says how many elements
/// are wrong.
fn wrong(credit: Credit, element: usize, count: Option<(usize, usize)>) -> Judgement {
    let [what, got, wanted] = ["interval", "None", "[0, 1]"].map(str::to_owned);
    let kind = FailureKind::Wrong {
        what,
        side: None,
        got,
        wanted,
    };
    let mut judgement = failed(credit, element, kind);
    judgement.failure.as_mut().unwrap().count = count;
    judgement
}

fn panicked(credit: Credit, message: &str, location: &str) -> Judgement {
    let panic = Panic {
        message: message.to_owned(),
        location: location.to_owned(),
    };
    failed(credit, 0, FailureKind::Panicked(panic))
}

/// Returns the score of an item with these questions, one for each judgement.
fn answered(questions: Vec<ExamQuestion>, judgements: Vec<Judgement>) -> ItemScore {
    assert_eq!(questions.len(), judgements.len());
    let outcome = ItemOutcome::answered(judgements);
    item_score(&item("bbox.through", questions), &outcome, &RAYS)
}

/// Returns the score of an item that asks two questions and has this outcome.
fn without_answer(outcome: &ItemOutcome) -> ItemScore {
    item_score(&item("bbox.through", vec![boxes(2)]), outcome, &RAYS)
}

mod answers;
mod no_answer;
mod other_items;
