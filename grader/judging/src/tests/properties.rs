//! Properties of judging, for all questions of the practice exam: the key's own answer passes, and a
//! worse answer never earns more.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::exam::{ExamQuestion, ExpectedHit, Key, RayCheck, Surface};
use crate::judge::{Credit, judge, measure, mismatches};
use crate::observe::{expected, observe};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use protocol::{Answer, ElementOutcome, Interval, Panic, Ray, Trace};

use super::EXAM;

/// The questions, each with the answer that follows from its key. Trees are left out: many different
/// ones are right.
static QUESTIONS: LazyLock<Vec<(&ExamQuestion, Answer)>> = LazyLock::new(|| {
    let questions = EXAM.items.iter().flat_map(|item| &item.questions);
    questions
        .filter_map(|question| Some((question, keys_answer(question)?)))
        .collect()
});

const UNIT: Trace = Trace {
    distance: 1.0,
    position: Vec3::ONE,
    normal: Vec3::X,
    uv: Vec2::ZERO,
    origin: Vec3::ZERO,
    material: 0,
};

fn values<T>(all: impl IntoIterator<Item = T>) -> Vec<ElementOutcome<T>> {
    all.into_iter().map(ElementOutcome::Value).collect()
}

/// Returns the answer that the key describes.
fn keys_answer(question: &ExamQuestion) -> Option<Answer> {
    Some(match &question.key {
        Key::Rays { directions, .. } => {
            let ray = |&dir: &Vec3| Ray {
                origin: Vec3::ZERO,
                dir,
                range: Interval::AHEAD,
            };
            Answer::Rays(values(directions.iter().map(ray)))
        }
        Key::Hits { hits, .. } => {
            let rays = question.question.rays();
            let rays = rays
                .expect("the key is that of a question with rays")
                .to_vec();
            let trace = |(hit, ray): (&ExpectedHit, &Ray)| Trace {
                distance: hit.distance,
                position: hit.position,
                normal: hit.normal,
                uv: hit.uv,
                origin: ray.origin,
                material: hit.material,
            };
            let hits = hits.iter().zip(&rays);
            let traces = hits.map(|(hit, ray)| Some(trace((hit.as_ref()?, ray))));
            Answer::Hits(values(traces))
        }
        Key::FirstHits { hits, .. } => {
            let trace = |surface: &Surface| Trace {
                distance: surface.depth,
                normal: surface.normal,
                uv: surface.uv,
                ..UNIT
            };
            Answer::Hits(values(hits.iter().map(|hit| hit.as_ref().map(trace))))
        }
        Key::Spans { spans } => Answer::Spans(values(spans.iter().copied())),
        Key::Radiance { pixels, .. } => Answer::Picture(ElementOutcome::Value(pixels.clone())),
        Key::Tree { .. } => return None,
    })
}

/// A way in which an element is wrong.
#[derive(Clone, Copy, Debug)]
enum Error {
    /// Numbers are too large by this fraction.
    Relative(f32),
    NotANumber,
    Panicked,
}

impl Error {
    fn number(self, number: f32) -> f32 {
        match self {
            Error::Relative(error) => number * (1.0 + error),
            Error::NotANumber | Error::Panicked => f32::NAN,
        }
    }

    fn vector(self, vector: Vec3) -> Vec3 {
        vector.map(|number| self.number(number))
    }

    fn spoil<T>(self, outcome: &mut ElementOutcome<T>, spoil: impl FnOnce(&mut T)) {
        match outcome {
            _ if matches!(self, Error::Panicked) => {
                *outcome = ElementOutcome::Panicked(Panic {
                    message: "index out of bounds".to_owned(),
                    location: "sphere.rs:1".to_owned(),
                });
            }
            ElementOutcome::Value(value) => spoil(value),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => {}
        }
    }

    /// Makes one element of a right answer wrong.
    fn apply(self, answer: &mut Answer, index: usize) {
        match answer {
            Answer::Rays(rays) => self.spoil(&mut rays[index], |ray| {
                ray.origin = self.vector(Vec3::ONE) - 1.0;
                ray.dir.x = self.number(ray.dir.x + 1.0) - 1.0;
                ray.range.min = self.number(1.0) - 1.0;
            }),
            Answer::Hits(hits) => self.spoil(&mut hits[index], |hit| match hit {
                Some(trace) => {
                    trace.distance = self.number(trace.distance);
                    trace.position = self.vector(trace.position);
                    trace.normal.x = self.number(trace.normal.x + 1.0) - 1.0;
                    trace.uv.y = self.number(trace.uv.y + 1.0) - 1.0;
                    trace.origin = self.vector(trace.origin);
                    trace.material += 1;
                }
                None => *hit = Some(UNIT),
            }),
            Answer::Spans(spans) => self.spoil(&mut spans[index], |span| match span {
                Some(times) => times.max = self.number(times.max),
                None => *span = Some(Interval::new(0.0, 1.0)),
            }),
            Answer::Picture(outcome) => self.spoil(outcome, |pixels| {
                pixels[index] = self.vector(pixels[index] + 1.0) - 1.0;
            }),
            Answer::Tree(_) | Answer::Done => unreachable!("these have no elements"),
        }
    }
}

fn count(answer: &Answer) -> usize {
    match answer {
        Answer::Rays(rays) => rays.len(),
        Answer::Hits(hits) => hits.len(),
        Answer::Spans(spans) => spans.len(),
        Answer::Picture(ElementOutcome::Value(pixels)) => pixels.len(),
        Answer::Picture(_) | Answer::Tree(_) | Answer::Done => {
            unreachable!("this is not the key's answer to anything")
        }
    }
}

fn any_error() -> impl Strategy<Value = Error> {
    prop_oneof![
        (0.5_f32..10.0).prop_map(Error::Relative),
        Just(Error::NotANumber),
        Just(Error::Panicked),
    ]
}

/// Returns distinct elements of an answer. With fewer numbers, there is a part of these elements.
fn elements(answer: &Answer, numbers: &[usize]) -> Vec<usize> {
    let mut elements: Vec<usize> = numbers.iter().map(|n| n % count(answer)).collect();
    elements.sort_unstable();
    elements.dedup();
    elements
}

/// Returns the credit of an answer in which these elements are wrong.
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
        let wrong = mismatches(question, answer).unwrap_or_default();
        assert!(wrong.iter().all(Option::is_none));
    }
}

#[test]
fn the_keys_own_answer_is_observed_as_expected() {
    for item in &EXAM.items {
        let answers: Option<Vec<Answer>> = item.questions.iter().map(keys_answer).collect();
        let Some(answers) = answers else { continue };
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

/// Questions of the same item may ask for the same thing in two sizes, so their answers may be alike in
/// everything that the item compares.
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
    for ((question, own), of) in QUESTIONS.iter().zip(&items) {
        for ((_, answer), other) in QUESTIONS.iter().zip(&items) {
            if of != other && own != answer {
                let credit = judge(question, answer).credit;
                assert!(credit < Credit::FULL, "{of:?} answered as {other:?}");
            }
        }
    }
}

/// An error in one number must not hide behind a right one beside it.
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
            Key::Rays { checks, .. } => checks.contains(&RayCheck::Direction),
            Key::Spans { .. } => true,
            Key::Hits { .. } | Key::FirstHits { .. } | Key::Radiance { .. } | Key::Tree { .. } => {
                false
            }
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
        let Key::Rays { checks, .. } = &question.key else {
            continue;
        };
        if checks.contains(&RayCheck::Range) {
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

/// Pictures are few of the questions, so random ones would hardly meet them.
#[test]
fn pictures_are_measured_and_masked_as_they_are_judged() {
    let mut kinds = BTreeSet::new();
    for (question, own) in QUESTIONS.iter() {
        if mismatches(question, own).is_none() {
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
            let measured = measure(question, &answer);
            assert!(!measured.is_empty());
            let is_right = measured
                .iter()
                .all(|one| one.deciding_deviation().is_right());
            assert_eq!(is_right, is_full, "{wrong} of {all} are wrong");
            let mask = mismatches(question, &answer).expect("there are as many answers");
            assert_eq!(mask.len(), all);
            assert_eq!(mask.iter().flatten().count(), wrong);
        }
        let mut short = own.clone();
        kinds.insert(match &mut short {
            Answer::Rays(rays) => rays.pop().map(|_| "rays"),
            Answer::Hits(hits) => hits.pop().map(|_| "first hits"),
            Answer::Picture(ElementOutcome::Value(pixels)) => pixels.pop().map(|_| "radiance"),
            Answer::Picture(_) | Answer::Spans(_) | Answer::Tree(_) | Answer::Done => {
                panic!("this is no picture: {own:?}")
            }
        });
        assert_eq!(judge(question, &short).credit, Credit::NONE);
        let measured = measure(question, &short);
        assert!(
            measured
                .iter()
                .any(|one| !one.deciding_deviation().is_right())
        );
        assert_eq!(mismatches(question, &short), None);
    }
    let all = ["first hits", "radiance", "rays"].map(Some);
    assert_eq!(Vec::from_iter(kinds), all);
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
        let measured = measure(question, &answer);
        let is_tolerated = measured.iter().all(|one| one.deciding_deviation().is_right());
        prop_assert_eq!(is_full, is_tolerated);
    }
}
