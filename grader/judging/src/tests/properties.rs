//! Properties that judging must have for every question in the practice exam: the key's own answer
//! passes, and a worse answer never earns more.

#![allow(
    clippy::wildcard_enum_match_arm,
    reason = "only some kinds of answers are treated in a special way"
)]

use std::collections::BTreeSet;

use proptest::prelude::*;
use protocol::{Answer, ElementOutcome, Interval, Ray};

use super::EXAM;
use super::answers::{Error, QUESTIONS, count};
use crate::exam::{ExamQuestion, ExpectedRows, Key};
use crate::judge::{Credit, judge, measure, mismatches, one_row_answers_all};
use crate::observe::{expected, observe};

fn any_error() -> impl Strategy<Value = Error> {
    prop_oneof![
        (0.5_f32..10.0).prop_map(Error::Relative),
        Just(Error::NotANumber),
        Just(Error::Panicked),
    ]
}

/// Maps these numbers to elements of an answer, without duplicates.
fn elements(answer: &Answer, numbers: &[usize]) -> Vec<usize> {
    let mut elements: Vec<usize> = numbers.iter().map(|n| n % count(answer)).collect();
    elements.sort_unstable();
    elements.dedup();
    elements
}

/// Returns the credit for an answer in which these elements are wrong.
fn credit(question: &ExamQuestion, answer: &Answer, wrong: &[usize], how: Error) -> Credit {
    let mut answer = answer.clone();
    for &element in wrong {
        how.apply(&mut answer, element);
    }
    judge(question, &answer).credit
}

#[test]
fn the_keys_own_answer_passes() {
    assert!(QUESTIONS.len() > 100);
    for (question, answer) in QUESTIONS.iter() {
        let judgement = judge(question, answer);
        assert_eq!(judgement.credit, Credit::FULL, "{:?}", judgement.failure);
        let wrong = mismatches(question, answer);
        assert_eq!(wrong.is_some(), is_picture(question));
        assert!(wrong.iter().flatten().all(Option::is_none));
    }
}

#[test]
fn the_keys_own_answer_is_observed_as_expected() {
    for item in &EXAM.items {
        let answers = item.questions.iter().map(|question| question.key.answer());
        let Some(answers) = answers.collect::<Option<Vec<Answer>>>() else {
            continue;
        };
        let (observed, expected) = (observe(item, &answers), expected(item));
        let is_picture = |question: &ExamQuestion| {
            matches!(question.key, Key::FirstHits { .. } | Key::Radiance { .. })
        };
        let elements = item.questions.iter();
        let elements = elements.filter(|question| !is_picture(question));
        let count = elements.map(|question| question.question.count()).sum();
        assert_eq!(
            (observed.len(), expected.len()),
            (count, count),
            "{}",
            item.id
        );
        for (observed, expected) in observed.iter().zip(&expected) {
            assert!(observed.matches(expected), "{}: {observed:?}", item.id);
        }
    }
}

#[test]
fn without_a_right_element_an_answer_earns_nothing() {
    for (question, answer) in QUESTIONS.iter() {
        let all: Vec<usize> = (0..count(answer)).collect();
        assert_eq!(
            credit(question, answer, &all, Error::Panicked),
            Credit::NONE
        );
    }
}

/// Questions of the same item are skipped: they may ask for the same thing in two sizes, so their
/// answers may be equal in everything that the item compares. Two more kinds of questions are
/// skipped, because answers to other items' questions may rightly pass: if a single row can answer
/// a whole question, as in questions about the length of a direction, a row from another question
/// may answer it too, and the same pattern of hits and misses can occur in two questions.
#[test]
fn answers_to_questions_of_other_items_do_not_pass() {
    let item = |question: &ExamQuestion| {
        let mut items = EXAM.items.iter();
        let is_own = |own: &ExamQuestion| std::ptr::eq(own, question);
        items.position(|item| item.questions.iter().any(is_own))
    };
    let items: Vec<_> = QUESTIONS
        .iter()
        .map(|(question, _)| item(question))
        .collect();
    let asked = QUESTIONS.iter().zip(&items);
    let says_more = |asked: &ExamQuestion| {
        let is_pattern = matches!(&asked.key, Key::Table { judged, .. } if judged.is_empty());
        !is_pattern && !one_row_answers_all(asked)
    };
    for ((question, own), of) in asked.filter(|((asked, _), _)| says_more(asked)) {
        for ((_, answer), other) in QUESTIONS.iter().zip(&items) {
            if of != other && own != answer {
                let credit = judge(question, answer).credit;
                assert!(credit < Credit::FULL, "{of:?} answered as {other:?}");
            }
        }
    }
}

/// An error in one number must not be hidden by a correct number next to it.
#[test]
fn each_end_of_an_interval_and_each_component_of_a_direction_counts_alone() {
    let spoil: [fn(&mut Answer, usize, f32); 5] = [
        |answer, index, by| with_span(answer, index, |span| span.min += by),
        |answer, index, by| with_span(answer, index, |span| span.max += by),
        |answer, index, by| with_ray(answer, index, |ray| ray.dir.x += by),
        |answer, index, by| with_ray(answer, index, |ray| ray.dir.y += by),
        |answer, index, by| with_ray(answer, index, |ray| ray.dir.z += by),
    ];
    let mut spoiled = [0; 5];
    for (question, own) in QUESTIONS.iter() {
        let checks_directions = match &question.key {
            Key::Table { judged, rows, .. } => match rows {
                ExpectedRows::Rays(_) | ExpectedRows::Directions(_) => {
                    judged.iter().any(|name| name == "direction")
                }
                ExpectedRows::Spans(_) => true,
                _ => false,
            },
            Key::FirstHits { .. }
            | Key::Radiance { .. }
            | Key::Tree { .. }
            | Key::SpreadEvenly { .. } => false,
        };
        let is_table = checks_directions && count(own) < 1000;
        for (spoil, done) in spoil.iter().zip(&mut spoiled) {
            for by in [1e6, f32::NAN, f32::INFINITY] {
                let mut answer = own.clone();
                spoil(&mut answer, 0, by);
                if is_table && format!("{answer:?}") != format!("{own:?}") {
                    assert_eq!(judge(question, &answer).credit, Credit::NONE, "{answer:?}");
                    *done += 1;
                }
            }
        }
    }
    assert!(spoiled.iter().all(|count| *count > 0), "{spoiled:?}");
}

#[test]
fn a_range_counts_at_both_ends() {
    let mut asked = 0;
    for (question, own) in QUESTIONS.iter() {
        let Key::Table { judged, .. } = &question.key else {
            continue;
        };
        if judged.iter().any(|name| name == "range") {
            for range in [Interval::new(1.0, f32::INFINITY), Interval::new(0.0, 1e6)] {
                let mut answer = own.clone();
                with_ray(&mut answer, 0, |ray| ray.range = range);
                assert_eq!(judge(question, &answer).credit, Credit::NONE);
                asked += 1;
            }
        }
    }
    assert!(asked > 0);
}

fn with_span(answer: &mut Answer, index: usize, change: impl Fn(&mut Interval)) {
    if let Answer::Spans(spans) = answer
        && let ElementOutcome::Value(Some(span)) = &mut spans[index]
    {
        change(span);
    }
}

fn with_ray(answer: &mut Answer, index: usize, change: impl Fn(&mut Ray)) {
    if let Answer::Rays(rays) = answer
        && let ElementOutcome::Value(ray) = &mut rays[index]
    {
        change(ray);
    }
}

/// Tests each kind of table explicitly, because a random choice would rarely pick a rare kind.
#[test]
fn tables_are_measured_as_they_are_judged() {
    let mut asked = BTreeSet::new();
    for (question, own) in QUESTIONS.iter() {
        if is_picture(question) {
            continue;
        }
        asked.insert(kind(own));
        assert!(is_tolerated(question, own), "{own:?}");
        let last = count(own) - 1;
        for how in [Error::Relative(1.0), Error::NotANumber, Error::Panicked] {
            let mut answer = own.clone();
            how.apply(&mut answer, last);
            let is_full = judge(question, &answer).credit == Credit::FULL;
            assert_eq!(is_tolerated(question, &answer), is_full, "{answer:?}");
        }
    }
    assert_eq!(Vec::from_iter(asked), ["hits", "rays", "spans"]);
}

/// Few questions are pictures, so a random choice would rarely pick one. The smallest of each kind
/// is enough.
#[test]
fn pictures_are_measured_and_masked_as_they_are_judged() {
    let mut kinds = BTreeSet::new();
    let mut questions: Vec<_> = QUESTIONS.iter().collect();
    questions.sort_by_key(|(_, own)| count(own));
    for (question, own) in questions {
        if !is_picture(question) || !kinds.insert(kind(own)) {
            continue;
        }
        let all = count(own);
        for wrong in [0, 1, 3, all / 30, all] {
            let mut answer = own.clone();
            for element in 0..wrong {
                Error::Relative(1.0).apply(&mut answer, element);
            }
            let judgement = judge(question, &answer);
            let is_full = judgement.credit == Credit::FULL;
            assert_eq!(judgement.failure.is_none(), is_full);
            assert!(!measure(question, &answer).is_empty());
            let is_tolerated = is_tolerated(question, &answer);
            assert_eq!(is_tolerated, is_full, "{wrong} of {all} are wrong");
            let mask = mismatches(question, &answer).expect("there are as many answers");
            assert_eq!(mask.len(), all);
            assert_eq!(mask.iter().flatten().count(), wrong);
        }
        let mut short = own.clone();
        match &mut short {
            Answer::Rays(rays) => drop(rays.pop()),
            Answer::Hits(hits) => drop(hits.pop()),
            Answer::Picture(ElementOutcome::Value(pixels)) => drop(pixels.pop()),
            _ => {}
        }
        assert_eq!(judge(question, &short).credit, Credit::NONE);
        assert!(!is_tolerated(question, &short));
        assert_eq!(mismatches(question, &short), None);
    }
    assert_eq!(Vec::from_iter(kinds), ["hits", "picture", "rays"]);
}

/// Returns whether all measured errors of an answer are small enough.
fn is_tolerated(question: &ExamQuestion, answer: &Answer) -> bool {
    let measured = measure(question, answer);
    measured
        .iter()
        .all(|one| one.deciding_deviation().is_right())
}

fn is_picture(question: &ExamQuestion) -> bool {
    question.question.film().is_some()
}

/// Returns the name of an answer's kind.
fn kind(answer: &Answer) -> &'static str {
    match answer {
        Answer::Rays(_) => "rays",
        Answer::Hits(_) => "hits",
        Answer::Spans(_) => "spans",
        Answer::Picture(_) => "picture",
        Answer::Tree(_) => "tree",
        _ => "light",
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn more_wrong_elements_never_earn_more(
        index: prop::sample::Index,
        numbers in prop::collection::vec(0_usize..1 << 20, 1..400),
        part: prop::sample::Index,
        how in any_error(),
    ) {
        let (question, answer) = index.get(&QUESTIONS);
        let few = &numbers[..part.index(numbers.len())];
        let few = credit(question, answer, &elements(answer, few), how);
        let many = credit(question, answer, &elements(answer, &numbers), how);
        prop_assert!(many <= few, "{:?} > {:?}", many, few);
    }

    #[test]
    fn a_larger_error_never_earns_more(
        index: prop::sample::Index,
        numbers in prop::collection::vec(0_usize..1 << 20, 1..400),
        small in 1e-6_f32..1e-1,
        factor in 1.0_f32..100.0,
    ) {
        let (question, answer) = index.get(&QUESTIONS);
        let wrong = elements(answer, &numbers);
        let credit = |error| credit(question, answer, &wrong, Error::Relative(error));
        prop_assert!(credit(small * factor) <= credit(small));
    }

    #[test]
    fn full_credit_means_that_all_measured_errors_are_tolerated(
        index: prop::sample::Index,
        numbers in prop::collection::vec(0_usize..1 << 20, 1..20),
        error in 1e-6_f32..1e-2,
    ) {
        let (question, answer) = index.get(&QUESTIONS);
        let mut answer = answer.clone();
        for element in elements(&answer, &numbers) {
            Error::Relative(error).apply(&mut answer, element);
        }
        let is_full = judge(question, &answer).credit == Credit::FULL;
        prop_assert_eq!(is_full, is_tolerated(question, &answer));
    }
}
