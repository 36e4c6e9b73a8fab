//! Tests of recognition with small exams. Each element of an item is observed as one number.
//!
//! Exams and answers are written as text: items are separated by `|`, and their elements by spaces.
//! `7` is a number far from the others, `7*3` stands for `7 7 7`, `miss` for a ray that hits
//! nothing, `panic`, `index` and `stack` for a missing answer, and a name in quotes for a tree
//! defect. In a mistake's answers, an empty item means that the mistake leaves it correct.

use super::*;
use crate::assignment::RAYS;
use crate::exam::Exam;
use crate::signatures::{MistakeAnswers, MistakeSignatures, PanicKind};

/// Parses the answers to each item.
fn items(text: &str) -> Vec<Vec<ObservedAnswer>> {
    let one = |word: &str| match word {
        "miss" => ObservedAnswer::NoHit,
        "panic" => ObservedAnswer::Panicked,
        "index" => ObservedAnswer::PanickedBy(PanicKind::Index),
        "stack" => ObservedAnswer::NoAnswer(NoAnswerReason::Stack),
        "'valid'" => ObservedAnswer::Tree(None),
        _ if word.starts_with('\'') => ObservedAnswer::Tree(Some((word.to_owned(), 0.0))),
        _ => ObservedAnswer::Numbers(vec![100.0 * word.parse::<f32>().unwrap()]),
    };
    let repeated = |word: &str| {
        let (word, count) = word.split_once('*').unwrap_or((word, "1"));
        vec![one(word); count.parse().unwrap()]
    };
    let item = |item: &str| item.split_whitespace().flat_map(repeated).collect();
    text.split('|').map(item).collect()
}

/// A mistake's hint and its answers to the items of an exam.
type Mistake<'a> = (&'a str, &'a str);

/// Returns the hints for each item in an exam with one task, given the correct answers, the known
/// mistakes and a submission's answers. Mistakes with the same hint share a name here.
fn explain(correct: &str, mistakes: &[Mistake], answers: &str) -> String {
    let correct = items(correct);
    let wrong: Vec<_> = mistakes.iter().map(|(_, answers)| items(answers)).collect();
    let task = RAYS.tasks[0].task();
    let item = |(index, correct): (usize, &Vec<ObservedAnswer>)| {
        let changed = |(mistake, answers): (usize, &Vec<Vec<ObservedAnswer>>)| {
            let elements = (0..).zip(&answers[index]).zip(correct);
            let wrong = elements.filter(|((_, answer), correct)| answer != correct);
            let answers: Vec<_> = wrong
                .map(|((element, answer), _)| (element, answer.clone()))
                .collect();
            (!answers.is_empty()).then(|| MistakeAnswers {
                mistakes: vec![mistake as u32],
                answers,
            })
        };
        Item {
            signatures: MistakeSignatures {
                elements: (0..correct.len() as u32).collect(),
                correct_answers: correct.clone(),
                mistake_answers: wrong.iter().enumerate().filter_map(changed).collect(),
            },
            ..Item::new(&format!("{task}.{index}"), 1, Vec::new())
        }
    };
    let known = mistakes.iter().map(|(hint, _)| KnownMistake {
        id: (*hint).to_owned(),
        nudge: String::new(),
        hint: (*hint).to_owned(),
        section: None,
    });
    let items_of_exam = correct.iter().enumerate().map(item).collect();
    let exam = Exam {
        mistakes: known.collect(),
        ..Exam::new(&RAYS, "small", items_of_exam)
    };
    let ids = exam.items.iter().map(|item| item.id.clone());
    let observations = Observations {
        answers: ids.zip(items(answers)).collect(),
        ..Observations::default()
    };
    let named = exam.items.iter().map(|item| {
        let mistakes = observations.explain(&exam, item).into_iter();
        let ids: Vec<&str> = mistakes.map(|mistake| mistake.id.as_str()).collect();
        ids.join(" ")
    });
    named.collect::<Vec<String>>().join("|")
}

/// Returns whether the mistake `known` is named for any item.
fn names_known(correct: &str, mistakes: &[Mistake], answers: &str) -> bool {
    let named = explain(correct, mistakes, answers);
    named.split(['|', ' ']).any(|id| id == "known")
}

mod beside_others;
mod pairs;
mod single_mistakes;
