//! What known mistakes answer, for an exam's key: asked of each, over the same pipe.

use std::collections::BTreeSet;

use grader::exam::{Exam, Item, Key};
use grader::probe::Fault;
use grader::recognise::{expected, observe};
use grader::signatures::{KnownMistake, MistakeAnswers, MistakeSignatures, ObservedAnswer};
use protocol::{Answer, Question, Samples};
use rayon::prelude::*;

use crate::proof::solutions::{ProofError, Solutions};
use crate::proof::workbench::WorkbenchError;

/// The most elements of an item that are told of.
const MAX_ELEMENTS: usize = 24;
/// So many are told of even if fewer tell the known mistakes apart: unknown ones are to show that
/// they are none of these.
const MIN_ELEMENTS: usize = 12;

/// The exam, with what every known mistake answers to some of its questions.
pub fn with_hints(mut exam: Exam, exhibits: &Solutions) -> Result<Exam, ProofError> {
    let answers: Vec<Vec<Option<Vec<ObservedAnswer>>>> = exhibits
        .mistakes
        .par_iter()
        .map(|(mistake, sources)| {
            let solution = exhibits.workbench.build(sources, &mistake.id)?;
            let items = exam.items.iter();
            let seen = items.map(|item| {
                let own = item.task == mistake.task() && is_table(item);
                own.then(|| observed_answers(item, solution.answers(item)))
                    .transpose()
            });
            seen.collect::<Result<_, ProofError>>()
        })
        .collect::<Result<_, ProofError>>()?;

    let mistakes = exhibits.mistakes.iter().map(|(mistake, _)| KnownMistake {
        id: mistake.id.clone(),
        nudge: mistake.nudge.clone(),
        hint: mistake.hint.clone(),
        section: mistake.section.clone(),
    });
    exam.mistakes = mistakes.collect();
    for (place, item) in exam.items.iter_mut().enumerate() {
        if is_table(item) {
            let by = (0..).zip(&answers);
            let told = by.filter_map(|(mistake, seen)| Some((mistake, seen[place].as_deref()?)));
            item.signatures = signatures(&expected(item), &told.collect::<Vec<_>>());
        }
    }
    Ok(exam)
}

/// Whether all that an item asks are tables and trees: of pictures nothing is told.
fn is_table(item: &Item) -> bool {
    item.questions
        .iter()
        .all(|asked| match (&asked.key, &asked.question) {
            (Key::Rays { .. }, Question::Camera { samples, .. }) => {
                matches!(samples, Samples::List(_))
            }
            (Key::Rays { .. } | Key::FirstHits { .. } | Key::Radiance { .. }, _) => false,
            (Key::Hits { .. } | Key::Spans { .. } | Key::Tree { .. }, _) => true,
        })
}

fn observed_answers(
    item: &Item,
    answers: std::io::Result<Result<Vec<Answer>, Fault>>,
) -> Result<Vec<ObservedAnswer>, ProofError> {
    Ok(match answers.map_err(WorkbenchError::from)? {
        Ok(answers) => observe(item, &answers),
        Err(fault) => {
            vec![ObservedAnswer::NoAnswer(fault.no_answer_reason()); expected(item).len()]
        }
    })
}

/// What is told of an item, given the right answers and each mistake's.
fn signatures(right: &[ObservedAnswer], told: &[(u32, &[ObservedAnswer])]) -> MistakeSignatures {
    let elements = choose_elements(right, told);
    let mut tells = MistakeSignatures {
        correct_answers: elements
            .iter()
            .map(|&element| right[element].clone())
            .collect(),
        elements: elements.iter().map(|&element| element as u32).collect(),
        mistake_answers: Vec::new(),
    };
    for (mistake, seen) in told {
        let wrong = (0..)
            .zip(&elements)
            .filter(|(_, element)| !seen[**element].matches(&right[**element]));
        let answers: Vec<(u32, ObservedAnswer)> = wrong
            .map(|(place, &element)| (place, seen[element].clone()))
            .collect();
        if answers.is_empty() {
            continue;
        }
        match tells
            .mistake_answers
            .iter_mut()
            .find(|other| same_answers(&other.answers, &answers))
        {
            Some(other) => other.mistakes.push(*mistake),
            None => tells.mistake_answers.push(MistakeAnswers {
                mistakes: vec![*mistake],
                answers,
            }),
        }
    }
    if tells.mistake_answers.is_empty() {
        return MistakeSignatures::default();
    }
    tells
}

fn same_answers(a: &[(u32, ObservedAnswer)], b: &[(u32, ObservedAnswer)]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(a, b)| a.0 == b.0 && a.1.matches(&b.1))
}

/// The elements that tell most apart: mistakes from each other and from what is right. Greedily,
/// each the one that tells most of what those before it do not.
fn choose_elements(right: &[ObservedAnswer], told: &[(u32, &[ObservedAnswer])]) -> Vec<usize> {
    let all: Vec<&[ObservedAnswer]> = told.iter().map(|(_, seen)| *seen).chain([right]).collect();
    let mut pairs: Vec<(usize, usize)> = (0..all.len())
        .flat_map(|b| (0..b).map(move |a| (a, b)))
        .collect();
    let differ =
        |element: usize, &(a, b): &(usize, usize)| !all[a][element].matches(&all[b][element]);
    let mut chosen = BTreeSet::new();
    while chosen.len() < MAX_ELEMENTS.min(right.len()) {
        let left = (0..right.len()).filter(|element| !chosen.contains(element));
        let gains = left.map(|element| {
            (
                pairs.iter().filter(|pair| differ(element, pair)).count(),
                element,
            )
        });
        // The first of the best: the order of equals must not matter.
        let Some((gain, best)) = gains.min_by_key(|(gain, element)| (usize::MAX - gain, *element))
        else {
            break;
        };
        // Where nothing is left to tell apart, any other element tells strangers.
        if gain == 0 && chosen.len() >= MIN_ELEMENTS {
            break;
        }
        pairs.retain(|pair| !differ(best, pair));
        chosen.insert(best);
    }
    chosen.into_iter().collect()
}
