//! What known mistakes answer, for an exam's key: asked of each, over the same pipe.

use std::collections::BTreeSet;

use grader::ask::Fault;
use grader::exam::{Exam, Item, Key};
use grader::recognise::{right, see_all};
use grader::tells::{KnownMistake, Seen, Tells, Told};
use protocol::{Answer, Question, Samples};
use rayon::prelude::*;

use crate::proof::exhibits::{Exhibits, NotProven};
use crate::proof::workbench::NotTried;

/// The most elements of an item that are told of.
const MOST: usize = 24;
/// So many are told of even if fewer tell the known mistakes apart: unknown ones are to show that
/// they are none of these.
const ENOUGH: usize = 12;

/// The exam, with what every known mistake answers to some of its questions.
pub fn with_hints(mut exam: Exam, exhibits: &Exhibits) -> Result<Exam, NotProven> {
    let answers: Vec<Vec<Option<Vec<Seen>>>> = exhibits
        .mistakes
        .par_iter()
        .map(|(mistake, sources)| {
            let solution = exhibits.workbench.build(sources, &mistake.id)?;
            let items = exam.items.iter();
            let seen = items.map(|item| {
                let own = item.task == mistake.task() && is_table(item);
                own.then(|| seen(item, solution.answers(item))).transpose()
            });
            seen.collect::<Result<_, NotProven>>()
        })
        .collect::<Result<_, NotProven>>()?;

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
            item.tells = tells(&right(item), &told.collect::<Vec<_>>());
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

fn seen(
    item: &Item,
    answers: std::io::Result<Result<Vec<Answer>, Fault>>,
) -> Result<Vec<Seen>, NotProven> {
    Ok(match answers.map_err(NotTried::from)? {
        Ok(answers) => see_all(item, &answers),
        Err(fault) => vec![Seen::NoAnswer(fault.silence()); right(item).len()],
    })
}

/// What is told of an item, given the right answers and each mistake's.
fn tells(right: &[Seen], told: &[(u32, &[Seen])]) -> Tells {
    let elements = choose(right, told);
    let mut tells = Tells {
        right: elements
            .iter()
            .map(|&element| right[element].clone())
            .collect(),
        elements: elements.iter().map(|&element| element as u32).collect(),
        wrong: Vec::new(),
    };
    for (mistake, seen) in told {
        let wrong = (0..)
            .zip(&elements)
            .filter(|(_, element)| !seen[**element].is_like(&right[**element]));
        let answers: Vec<(u32, Seen)> = wrong
            .map(|(place, &element)| (place, seen[element].clone()))
            .collect();
        if answers.is_empty() {
            continue;
        }
        match tells
            .wrong
            .iter_mut()
            .find(|other| same(&other.answers, &answers))
        {
            Some(other) => other.by.push(*mistake),
            None => tells.wrong.push(Told {
                by: vec![*mistake],
                answers,
            }),
        }
    }
    if tells.wrong.is_empty() {
        return Tells::default();
    }
    tells
}

fn same(a: &[(u32, Seen)], b: &[(u32, Seen)]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(a, b)| a.0 == b.0 && a.1.is_like(&b.1))
}

/// The elements that tell most apart: mistakes from each other and from what is right. Greedily,
/// each the one that tells most of what those before it do not.
fn choose(right: &[Seen], told: &[(u32, &[Seen])]) -> Vec<usize> {
    let all: Vec<&[Seen]> = told.iter().map(|(_, seen)| *seen).chain([right]).collect();
    let mut pairs: Vec<(usize, usize)> = (0..all.len())
        .flat_map(|b| (0..b).map(move |a| (a, b)))
        .collect();
    let differ =
        |element: usize, &(a, b): &(usize, usize)| !all[a][element].is_like(&all[b][element]);
    let mut chosen = BTreeSet::new();
    while chosen.len() < MOST.min(right.len()) {
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
        if gain == 0 && chosen.len() >= ENOUGH {
            break;
        }
        pairs.retain(|pair| !differ(best, pair));
        chosen.insert(best);
    }
    chosen.into_iter().collect()
}
