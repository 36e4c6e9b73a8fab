//! Tests of recognition with small exams, in which each element of an item has one number.

use super::*;
use crate::assignment::RAYS;
use crate::exam::Exam;
use crate::signatures::{MistakeAnswers, MistakeSignatures, PanicKind};

/// A number that is far from others.
fn number(number: i32) -> ObservedAnswer {
    ObservedAnswer::Numbers(vec![number as f32 * 100.0])
}

/// The answers of a mistake to the items of an exam, which it leaves correct where there is `None`.
type Mistake<'a> = (&'a str, &'a [Option<Vec<ObservedAnswer>>]);

/// Creates an exam of one task, given the correct answers to each item, and known mistakes, each with
/// its hint. Mistakes with the same hint have the same name here.
fn exam(correct: &[Vec<ObservedAnswer>], mistakes: &[Mistake]) -> Exam {
    let task = RAYS.tasks[0].task();
    let item = |(index, correct): (usize, &Vec<ObservedAnswer>)| {
        let changed = mistakes.iter().enumerate();
        let changed = changed.filter_map(|(mistake, (_, answers))| {
            let answers = answers[index].as_ref()?;
            let elements = (0..).zip(answers).zip(correct);
            let wrong = elements.filter(|((_, answer), correct)| answer != correct);
            Some(MistakeAnswers {
                mistakes: vec![mistake as u32],
                answers: wrong
                    .map(|((element, answer), _)| (element, answer.clone()))
                    .collect(),
            })
        });
        Item {
            id: format!("{task}.{index}"),
            title: String::new(),
            task,
            points: 1,
            look: String::new(),
            section: None,
            needs: Vec::new(),
            questions: Vec::new(),
            signatures: MistakeSignatures {
                elements: (0..correct.len() as u32).collect(),
                correct_answers: correct.clone(),
                mistake_answers: changed.collect(),
            },
        }
    };
    let known = mistakes.iter().map(|(hint, _)| KnownMistake {
        id: (*hint).to_owned(),
        nudge: String::new(),
        hint: (*hint).to_owned(),
        section: None,
    });
    Exam {
        schema: 1,
        assignment: RAYS.id.to_owned(),
        id: "small".to_owned(),
        mistakes: known.collect(),
        items: correct.iter().enumerate().map(item).collect(),
    }
}

/// Returns the ids of the mistakes that explain each item, given a submission's answers.
fn explained(exam: &Exam, answers: &[Vec<ObservedAnswer>]) -> Vec<Vec<String>> {
    let ids = exam.items.iter().map(|item| item.id.clone());
    let observations = Observations {
        answers: ids.zip(answers.iter().cloned()).collect(),
        ..Observations::default()
    };
    let of_item = |item| {
        let mistakes = observations.explain(exam, item).into_iter();
        mistakes.map(|mistake| mistake.id.clone()).collect()
    };
    exam.items.iter().map(of_item).collect()
}

/// Returns an item's answers with these numbers.
fn numbers(all: &[i32]) -> Vec<ObservedAnswer> {
    all.iter().copied().map(number).collect()
}

/// Returns an item's answers that are all this one.
fn all(answer: ObservedAnswer, count: usize) -> Vec<ObservedAnswer> {
    vec![answer; count]
}

const NOTHING: [&str; 0] = [];

mod alone;
mod beside_others;
mod pairs;
