//! Adds the signatures of known mistakes to an exam. The grader bases its hints on these
//! signatures. To record them, every mistake is built and run on the exam's questions, like any
//! submission.

use std::collections::BTreeSet;

use anyhow::{Result, ensure};
use judging::exam::{Exam, Item, Key};
use judging::observe::{expected, observe};
use judging::signatures::{
    KnownMistake, MistakeAnswers, MistakeSignatures, NoAnswerReason, ObservedAnswer,
};
use protocol::{Geometry, Question};
use rayon::prelude::*;

use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::Answers;

/// The maximum number of elements that a signature records for an item.
const MAX_ELEMENTS: usize = 32;
/// The minimum number of recorded elements, even if fewer would distinguish all known mistakes. The
/// additional elements help to recognise unknown mistakes.
const MIN_ELEMENTS: usize = 12;
/// The number of wrong answers to record for each mistake. With fewer, the mistake could be
/// confused with a different one that gives only a few of the same wrong answers.
const WRONG_ANSWERS: usize = 4;

/// The answers of a known mistake to each item. `None` for items without signatures and for items
/// in other tasks.
struct RecordedMistake<'s> {
    mistake: &'s Mistake,
    answers: Vec<Option<Vec<ObservedAnswer>>>,
}

/// Adds all known mistakes to the exam, along with each mistake's answers to some of the questions.
/// A mistake is listed again for each other form of the reference's code in which it gives
/// different answers.
pub fn with_hints(mut exam: Exam, solutions: &Solutions) -> Result<Exam> {
    let known = record(&exam, solutions, &solutions.mistakes)?;
    let in_other_forms = record(&exam, solutions, &solutions.mistakes_in_other_forms)?;
    let known_count = known.len();
    let mut recorded = known;
    for form in in_other_forms {
        if recorded.iter().any(|other| other.covers(&form)) {
            continue;
        }
        let is_own = |other: &&RecordedMistake| other.mistake.id == form.mistake.id;
        let mut own = recorded.iter().filter(is_own);
        ensure!(
            !form.times_out() || own.any(RecordedMistake::times_out),
            "the mistake {} runs out of time in another form of the reference's code, but not in the \
             reference itself. On a faster machine, that form might finish in time, which would \
             change the exam. Change the form in forms.toml or remove it",
            form.mistake.id
        );
        recorded.push(form);
    }

    let mistakes = recorded.iter().map(|recorded| KnownMistake {
        id: recorded.mistake.id.clone(),
        nudge: recorded.mistake.nudge.clone(),
        hint: recorded.mistake.hint.clone(),
        section: recorded.mistake.section.clone(),
    });
    exam.mistakes = mistakes.collect();
    for (index, item) in exam.items.iter_mut().enumerate() {
        if is_table(item) {
            let by_mistake = (0..).zip(&recorded);
            let wrong: Vec<_> = by_mistake
                .filter_map(|(mistake, recorded)| {
                    Some((mistake, recorded.answers[index].as_deref()?))
                })
                .collect();
            item.signatures = signatures(&expected(item), &wrong, known_count as u32);
        }
    }
    Ok(exam)
}

/// Builds wrong solutions and runs them on the items of their tasks.
fn record<'s>(
    exam: &Exam,
    solutions: &'s Solutions,
    wrong: &[Solution],
) -> Result<Vec<RecordedMistake<'s>>> {
    let record = |solution: &Solution| {
        let mut catalogue = solutions.catalogue.iter();
        let mistake = catalogue.find(|mistake| mistake.id == solution.id);
        let built = solutions.workbench.build(&solution.sources, &solution.id)?;
        let items = exam.items.iter();
        let answers = items.map(|item| {
            let own = item.task == solution.task() && is_table(item);
            own.then(|| Ok(observed_answers(item, &built.answers(item)?)))
                .transpose()
        });
        Ok(RecordedMistake {
            mistake: mistake.expect("wrong solutions are made from the catalogue"),
            answers: answers.collect::<Result<_>>()?,
        })
    };
    wrong.par_iter().map(record).collect()
}

impl RecordedMistake<'_> {
    /// Returns whether an item was stopped at its time limit.
    fn times_out(&self) -> bool {
        let mut observed = self.answers.iter().flatten().flatten();
        observed.any(|answer| *answer == ObservedAnswer::NoAnswer(NoAnswerReason::Time))
    }

    /// Returns whether `form` is a form of the same mistake and gives the same answers. Its crashes
    /// are ignored, because many mistakes lead to crashes, so a crash says little about the cause.
    fn covers(&self, form: &RecordedMistake) -> bool {
        let items = self.answers.iter().zip(&form.answers);
        let mut pairs =
            items.flat_map(|(own, form)| own.iter().flatten().zip(form.iter().flatten()));
        self.mistake.id == form.mistake.id
            && pairs.all(|(own, form)| form.is_uninformative() || own.matches(form))
    }
}

/// Returns whether all questions of an item are tables or trees. Pictures don't have signatures.
/// Neither do trees that the submission both builds and traverses, because wrong answers about such
/// a tree depend on how the submission orders its nodes.
fn is_table(item: &Item) -> bool {
    item.questions
        .iter()
        .all(|question| match (&question.key, &question.question) {
            (_, Question::Hit(table)) if matches!(table.subject, Geometry::BuiltTree { .. }) => {
                false
            }
            (Key::Table { .. }, asked) => asked.film().is_none(),
            (Key::Tree { .. }, _) => true,
            (Key::FirstHits { .. } | Key::Radiance { .. } | Key::SpreadEvenly { .. }, _) => false,
        })
}

/// Returns the observation for each element of an item.
pub fn observed_answers(item: &Item, answers: &Answers) -> Vec<ObservedAnswer> {
    match answers {
        Ok(answers) => observe(item, answers),
        Err(fault) => {
            vec![ObservedAnswer::NoAnswer(fault.no_answer_reason()); expected(item).len()]
        }
    }
}

/// Returns the signatures for an item, given the correct answers and each mistake's answers. The
/// first `known` mistakes are made in the reference's own form.
fn signatures(
    correct: &[ObservedAnswer],
    by_mistake: &[(u32, &[ObservedAnswer])],
    known: u32,
) -> MistakeSignatures {
    let elements = choose_elements(correct, by_mistake, known);
    let mut all: Vec<MistakeAnswers> = Vec::new();
    for (mistake, observed) in by_mistake {
        let answers = (0..).zip(elements.iter().map(|&element| observed[element].clone()));
        let is_wrong = |(index, got): &(u32, ObservedAnswer)| {
            !got.matches(&correct[elements[*index as usize]])
        };
        let answers: Vec<(u32, ObservedAnswer)> = answers.filter(is_wrong).collect();
        if answers.is_empty() {
            continue;
        }
        match all
            .iter_mut()
            .find(|other| same_answers(&other.answers, &answers))
        {
            Some(other) => other.mistakes.push(*mistake),
            None => all.push(MistakeAnswers {
                mistakes: vec![*mistake],
                answers,
            }),
        }
    }
    if all.is_empty() {
        return MistakeSignatures::default();
    }
    let correct_answers = elements.iter().map(|&element| correct[element].clone());
    MistakeSignatures {
        correct_answers: correct_answers.collect(),
        elements: elements.iter().map(|&element| element as u32).collect(),
        mistake_answers: all,
    }
}

fn same_answers(a: &[(u32, ObservedAnswer)], b: &[(u32, ObservedAnswer)]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(a, b)| a.0 == b.0 && a.1.matches(&b.1))
}

/// Returns the elements that best distinguish the mistakes from each other and from correct
/// answers. The choice is greedy: each step adds the element that distinguishes the most remaining
/// pairs. The forms of a mistake need not be distinguished, so only the first `known` mistakes form
/// pairs. Then, for each mistake with too few wrong answers among the chosen elements, adds more
/// elements that the mistake gets wrong.
fn choose_elements(
    correct: &[ObservedAnswer],
    by_mistake: &[(u32, &[ObservedAnswer])],
    known: u32,
) -> Vec<usize> {
    let distinguished = by_mistake.iter().filter(|(mistake, _)| *mistake < known);
    let mistakes = distinguished.map(|(_, observed)| *observed);
    let all: Vec<&[ObservedAnswer]> = mistakes.chain([correct]).collect();
    let mut pairs: Vec<(usize, usize)> = (0..all.len())
        .flat_map(|b| (0..b).map(move |a| (a, b)))
        .collect();
    let differ =
        |element: usize, &(a, b): &(usize, usize)| !all[a][element].matches(&all[b][element]);
    let mut chosen = BTreeSet::new();
    while chosen.len() < MAX_ELEMENTS.min(correct.len()) {
        let left = (0..correct.len()).filter(|element| !chosen.contains(element));
        let gain = |element| pairs.iter().filter(|pair| differ(element, pair)).count();
        let gains = left.map(|element| (gain(element), element));
        // Among elements with equal gains, choose the first, so that the result is deterministic.
        let Some((gain, best)) = gains.min_by_key(|(gain, element)| (usize::MAX - gain, *element))
        else {
            break;
        };
        // Elements without a gain only help to tell unknown mistakes from known ones, so add such
        // elements only up to the minimum.
        if gain == 0 && chosen.len() >= MIN_ELEMENTS {
            break;
        }
        pairs.retain(|pair| !differ(best, pair));
        chosen.insert(best);
    }
    for (_, observed) in by_mistake {
        let is_wrong = |element: &usize| !observed[*element].matches(&correct[*element]);
        let wrong: Vec<usize> = (0..correct.len()).filter(is_wrong).collect();
        let known = wrong.iter().filter(|&it| chosen.contains(it)).count();
        let more = known..WRONG_ANSWERS.min(wrong.len());
        // Answers from different parts of an item differ more than neighbouring ones.
        let spread = more.map(|index| wrong[index * wrong.len() / WRONG_ANSWERS]);
        let room = MAX_ELEMENTS.saturating_sub(chosen.len());
        chosen.extend(spread.take(room));
    }
    chosen.into_iter().collect()
}
