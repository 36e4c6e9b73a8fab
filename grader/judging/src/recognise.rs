//! Recognises the known mistake behind a wrong answer.
//!
//! A mistake *explains* an item if the submission's answers to the item's signature elements equal
//! those of the mistake. A mistake is named only if it explains every item of the task that it
//! affects, because a false hint is worse than none. Items that the mistake does not affect may be
//! wrong for other reasons. Of several such mistakes, the one that explains the most items is
//! named. In case of a tie, all of them are named.

use std::collections::BTreeMap;

use protocol::{Answer, ElementOutcome, Interval, Ray, Trace};

use crate::assignment::Task;
use crate::exam::{Exam, ExamQuestion, ExpectedHit, HitCheck, Item, Key, RayCheck};
use crate::judge::{FailureKind, judge};
use crate::signatures::{KnownMistake, MistakeAnswers, NoAnswerReason, ObservedAnswer};

/// Maximum number of mistakes to name for an item. If there are more, none is named, because a long
/// list would not help.
pub const MAX_MISTAKES: usize = 3;

/// A submission's answers to the signature elements of each item, by item id.
#[derive(Clone, Debug, Default)]
pub struct Observations(BTreeMap<String, Vec<ObservedAnswer>>);

impl Observations {
    /// Records the answers to an item, or the reason why there are none.
    pub fn record(&mut self, item: &Item, answers: Result<&[Answer], NoAnswerReason>) {
        if item.signatures.elements.is_empty() {
            return;
        }
        let observed = match answers {
            Ok(answers) => {
                let all = observe(item, answers);
                let elements = item.signatures.elements.iter();
                elements
                    .map(|&element| {
                        all.get(element as usize)
                            .cloned()
                            .unwrap_or(ObservedAnswer::NoAnswer(NoAnswerReason::Other))
                    })
                    .collect()
            }
            Err(why) => vec![ObservedAnswer::NoAnswer(why); item.signatures.elements.len()],
        };
        self.0.insert(item.id.clone(), observed);
    }

    /// Returns the known mistakes that explain an item. There are several if the answers do not
    /// distinguish them.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let Some(observed) = self.0.get(&item.id) else {
            return Vec::new();
        };
        if self.is_uninformative(exam, item.task) {
            return Vec::new();
        }
        let explaining = item
            .signatures
            .mistake_answers
            .iter()
            .filter(|answers| explains(item, answers, observed));
        let candidates = explaining.flat_map(|answers| &answers.mistakes);
        let explained: Vec<(u32, usize)> = candidates
            .filter_map(|&mistake| Some((mistake, self.explained_items(exam, item.task, mistake)?)))
            .collect();
        let Some(most) = explained.iter().map(|(_, count)| *count).max() else {
            return Vec::new();
        };
        let best = explained.iter().filter(|(_, count)| *count == most);
        let best: Vec<&KnownMistake> = best
            .filter_map(|(mistake, _)| exam.mistakes.get(*mistake as usize))
            .collect();
        if best.len() > MAX_MISTAKES {
            Vec::new()
        } else {
            best
        }
    }

    /// Returns whether no answer in the whole task says anything about the cause, because the code
    /// only panicked or gave no answers.
    fn is_uninformative(&self, exam: &Exam, task: Task) -> bool {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut observed = items.filter_map(|item| self.0.get(&item.id)).flatten();
        observed.all(ObservedAnswer::is_uninformative)
    }

    /// Returns how many items of a task a mistake explains, or `None` if an item contradicts it.
    fn explained_items(&self, exam: &Exam, task: Task, mistake: u32) -> Option<usize> {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut count = 0;
        for item in items {
            let mut all = item.signatures.mistake_answers.iter();
            let answers = all.find(|answers| answers.mistakes.contains(&mistake));
            match (answers, self.0.get(&item.id)) {
                (Some(answers), Some(observed)) if explains(item, answers, observed) => count += 1,
                (Some(_), Some(_)) => return None,
                // The mistake does not affect this item, so a wrong answer here has another cause.
                (None, _) | (_, None) => {}
            }
        }
        Some(count)
    }
}

/// Returns whether the submission's answers equal those that the mistake gives, including the
/// answers that the mistake leaves correct.
fn explains(item: &Item, answers: &MistakeAnswers, observed: &[ObservedAnswer]) -> bool {
    let mut wrong = answers.answers.iter().peekable();
    observed
        .iter()
        .zip(&item.signatures.correct_answers)
        .enumerate()
        .all(|(index, (observed, correct))| {
            match wrong.next_if(|(other, _)| *other as usize == index) {
                Some((_, answer)) => observed.matches(answer),
                None => observed.matches(correct),
            }
        })
}

/// Reduces the answers to an item to observations, one for each element.
pub fn observe(item: &Item, answers: &[Answer]) -> Vec<ObservedAnswer> {
    let questions = item.questions.iter().zip(answers);
    questions
        .flat_map(|(question, answer)| observe_question(question, answer))
        .collect()
}

/// Returns the observations that correct answers would give, one for each element of an item.
pub fn expected(item: &Item) -> Vec<ObservedAnswer> {
    item.questions.iter().flat_map(expected_elements).collect()
}

fn expected_elements(question: &ExamQuestion) -> Vec<ObservedAnswer> {
    match &question.key {
        Key::Rays { checks, directions } => {
            let ray = |dir| Ray {
                origin: glam::Vec3::ZERO,
                dir,
                range: Interval::AHEAD,
            };
            directions
                .iter()
                .map(|&dir| observe_ray(checks, &ray(dir)))
                .collect()
        }
        Key::Hits { checks, hits } => {
            let rays = match &question.question {
                protocol::Question::Shapes { rays, .. }
                | protocol::Question::Traverse { rays, .. }
                | protocol::Question::BuildAndTraverse { rays, .. } => rays.to_vec(),
                protocol::Question::Camera { .. }
                | protocol::Question::BBox { .. }
                | protocol::Question::Build { .. }
                | protocol::Question::Radiance { .. }
                | protocol::Question::Done => Vec::new(),
            };
            let trace = |hit: &ExpectedHit, ray: &Ray| Trace {
                distance: hit.distance,
                position: hit.position,
                normal: hit.normal,
                uv: hit.uv,
                origin: ray.origin,
                material: hit.material,
            };
            let traces = hits
                .iter()
                .zip(&rays)
                .map(|(hit, ray)| hit.as_ref().map(|hit| trace(hit, ray)));
            traces
                .map(|trace| observe_hit(checks, trace.as_ref()))
                .collect()
        }
        Key::Spans { spans } => spans.iter().map(|span| observe_span(*span)).collect(),
        Key::Tree { .. } => vec![ObservedAnswer::Tree(None)],
        Key::FirstHits { .. } | Key::Radiance { .. } => Vec::new(),
    }
}

fn observe_question(question: &ExamQuestion, answer: &Answer) -> Vec<ObservedAnswer> {
    match (&question.key, answer) {
        (Key::Rays { checks, .. }, Answer::Rays(rays)) => {
            observe_each(rays, |ray| observe_ray(checks, ray))
        }
        (Key::Hits { checks, .. }, Answer::Hits(hits)) => {
            observe_each(hits, |hit| observe_hit(checks, hit.as_ref()))
        }
        (Key::Spans { .. }, Answer::Spans(spans)) => {
            observe_each(spans, |span| observe_span(*span))
        }
        (Key::Tree { .. }, Answer::Tree(tree)) => observe_each(std::slice::from_ref(tree), |_| {
            observe_tree(question, answer)
        }),
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. },
            _,
        ) => Vec::new(),
    }
}

fn observe_each<T>(
    outcomes: &[ElementOutcome<T>],
    see: impl Fn(&T) -> ObservedAnswer,
) -> Vec<ObservedAnswer> {
    let observed = outcomes.iter().map(|outcome| match outcome {
        ElementOutcome::Value(value) => see(value),
        ElementOutcome::Panicked(_) | ElementOutcome::Skipped => ObservedAnswer::Panicked,
    });
    observed.collect()
}

fn observe_ray(checks: &[RayCheck], ray: &Ray) -> ObservedAnswer {
    let part = |part: &RayCheck| match part {
        RayCheck::Origin => ray.origin.to_array().to_vec(),
        RayCheck::Direction => (ray.dir / ray.dir.length()).to_array().to_vec(),
        RayCheck::UnitLength => vec![ray.dir.length()],
        RayCheck::Range => vec![ray.range.min, ray.range.max],
    };
    ObservedAnswer::Numbers(checks.iter().flat_map(part).collect())
}

fn observe_hit(checks: &[HitCheck], trace: Option<&Trace>) -> ObservedAnswer {
    let Some(trace) = trace else {
        return ObservedAnswer::NoHit;
    };
    let part = |part: &HitCheck| match part {
        HitCheck::Distance => vec![trace.distance],
        HitCheck::Position => trace.position.to_array().to_vec(),
        HitCheck::Normal => (trace.normal / trace.normal.length()).to_array().to_vec(),
        HitCheck::UnitNormal => vec![trace.normal.length()],
        HitCheck::Uv => trace.uv.to_array().to_vec(),
        HitCheck::Origin => trace.origin.to_array().to_vec(),
        HitCheck::Material => vec![trace.material as f32],
    };
    ObservedAnswer::Numbers(checks.iter().flat_map(part).collect())
}

fn observe_span(span: Option<Interval>) -> ObservedAnswer {
    span.map_or(ObservedAnswer::NoHit, |span| {
        ObservedAnswer::Numbers(vec![span.min, span.max])
    })
}

/// Returns the defect that the judge finds in a tree. Correct builders produce different trees, so
/// the nodes themselves cannot be compared.
fn observe_tree(question: &ExamQuestion, answer: &Answer) -> ObservedAnswer {
    let defect = judge(question, answer).failure.map(|failure| failure.kind);
    match defect {
        None => ObservedAnswer::Tree(None),
        Some(FailureKind::Wrong { what, got, .. }) => {
            // If the defect has an amount, this is the first word of `got`. Other numbers are
            // indices, which differ between submissions.
            let amount = got.split(' ').next().and_then(|word| word.parse().ok());
            let is_word = |word: &&str| !word.contains(|c: char| c.is_ascii_digit());
            let words: Vec<&str> = got.split(' ').filter(is_word).collect();
            let found = format!("{what}: {}", words.join(" "));
            ObservedAnswer::Tree(Some((found, amount.unwrap_or(0.0))))
        }
        Some(FailureKind::Panicked(_)) => ObservedAnswer::Panicked,
        Some(FailureKind::Protocol(_)) => ObservedAnswer::NoAnswer(NoAnswerReason::Other),
    }
}
