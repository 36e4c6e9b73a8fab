//! From which known mistake a wrong answer comes, if that can be told.
//!
//! A mistake explains an item if it answers all the elements that the key tells of as the
//! submission did. It is only named if it explains every item of the task that it gets wrong: no
//! hint is better than a false one. What else is wrong may have another reason. Of several mistakes
//! the one that explains most items comes first; where two explain the same, both are named.

use std::collections::BTreeMap;

use protocol::{Answer, ElementOutcome, Interval, Ray, Trace};

use crate::exam::{Exam, ExamQuestion, ExpectedHit, HitCheck, Item, Key, RayCheck, Task};
use crate::judge::{FailureKind, judge};
use crate::signatures::{KnownMistake, MistakeAnswers, NoAnswerReason, ObservedAnswer};

/// The most mistakes that are named together. More than that is no hint.
const MAX_MISTAKES: usize = 3;

/// What was seen of a submission's answers to the elements that the keys tell of, by item.
#[derive(Clone, Debug, Default)]
pub struct Observations(BTreeMap<String, Vec<ObservedAnswer>>);

impl Observations {
    /// Notes the answers to an item, or why there were none.
    pub fn record(&mut self, item: &Item, answers: Result<&[Answer], NoAnswerReason>) {
        if item.signatures.elements.is_empty() {
            return;
        }
        let seen = match answers {
            Ok(answers) => {
                let all = observe(item, answers);
                let told = item.signatures.elements.iter();
                told.map(|&element| {
                    all.get(element as usize)
                        .cloned()
                        .unwrap_or(ObservedAnswer::NoAnswer(NoAnswerReason::Other))
                })
                .collect()
            }
            Err(why) => vec![ObservedAnswer::NoAnswer(why); item.signatures.elements.len()],
        };
        self.0.insert(item.id.clone(), seen);
    }

    /// The known mistakes that explain an item, the likeliest, or several that nothing tells apart.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let Some(seen) = self.0.get(&item.id) else {
            return Vec::new();
        };
        if self.is_uninformative(exam, item.task) {
            return Vec::new();
        }
        let told = item
            .signatures
            .mistake_answers
            .iter()
            .filter(|told| explains(item, told, seen));
        let candidates = told.flat_map(|told| &told.mistakes);
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

    /// Whether there is nothing to go by in a whole task: no right answer, and no wrong one either.
    fn is_uninformative(&self, exam: &Exam, task: Task) -> bool {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut seen = items.filter_map(|item| self.0.get(&item.id)).flatten();
        seen.all(ObservedAnswer::is_uninformative)
    }

    /// How many items of a task a mistake explains; none if something speaks against it.
    fn explained_items(&self, exam: &Exam, task: Task, mistake: u32) -> Option<usize> {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut count = 0;
        for item in items {
            let mut told = item.signatures.mistake_answers.iter();
            let told = told.find(|told| told.mistakes.contains(&mistake));
            match (told, self.0.get(&item.id)) {
                (Some(told), Some(seen)) if explains(item, told, seen) => count += 1,
                (Some(_), Some(_)) => return None,
                // What else is wrong may have another reason.
                (None, _) | (_, None) => {}
            }
        }
        Some(count)
    }
}

/// Whether these answers are the submission's, wrong ones and right ones.
fn explains(item: &Item, told: &MistakeAnswers, seen: &[ObservedAnswer]) -> bool {
    let mut wrong = told.answers.iter().peekable();
    seen.iter()
        .zip(&item.signatures.correct_answers)
        .enumerate()
        .all(
            |(place, (seen, right))| match wrong.next_if(|(other, _)| *other as usize == place) {
                Some((_, answer)) => seen.matches(answer),
                None => seen.matches(right),
            },
        )
}

/// What is seen of each element of an item's answers.
pub fn observe(item: &Item, answers: &[Answer]) -> Vec<ObservedAnswer> {
    let asked = item.questions.iter().zip(answers);
    asked
        .flat_map(|(asked, answer)| observe_question(asked, answer))
        .collect()
}

/// What a right answer shows, of each element of an item.
pub fn expected(item: &Item) -> Vec<ObservedAnswer> {
    item.questions.iter().flat_map(expected_elements).collect()
}

fn expected_elements(asked: &ExamQuestion) -> Vec<ObservedAnswer> {
    match &asked.key {
        Key::Rays {
            checks: judged,
            directions,
        } => {
            let ray = |dir| Ray {
                origin: glam::Vec3::ZERO,
                dir,
                range: Interval::AHEAD,
            };
            directions
                .iter()
                .map(|&dir| observe_ray(judged, &ray(dir)))
                .collect()
        }
        Key::Hits {
            checks: judged,
            hits,
        } => {
            let rays = match &asked.question {
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
                .map(|trace| observe_hit(judged, trace.as_ref()))
                .collect()
        }
        Key::Spans { spans } => spans.iter().map(|span| observe_span(*span)).collect(),
        Key::Tree { .. } => vec![ObservedAnswer::Tree(None)],
        Key::FirstHits { .. } | Key::Radiance { .. } => Vec::new(),
    }
}

fn observe_question(asked: &ExamQuestion, answer: &Answer) -> Vec<ObservedAnswer> {
    match (&asked.key, answer) {
        (Key::Rays { checks: judged, .. }, Answer::Rays(rays)) => {
            observe_each(rays, |ray| observe_ray(judged, ray))
        }
        (Key::Hits { checks: judged, .. }, Answer::Hits(hits)) => {
            observe_each(hits, |hit| observe_hit(judged, hit.as_ref()))
        }
        (Key::Spans { .. }, Answer::Spans(spans)) => {
            observe_each(spans, |span| observe_span(*span))
        }
        (Key::Tree { .. }, Answer::Tree(tree)) => {
            observe_each(std::slice::from_ref(tree), |_| observe_tree(asked, answer))
        }
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
    let seen = outcomes.iter().map(|outcome| match outcome {
        ElementOutcome::Value(value) => see(value),
        ElementOutcome::Panicked(_) | ElementOutcome::Skipped => ObservedAnswer::Panicked,
    });
    seen.collect()
}

fn observe_ray(judged: &[RayCheck], ray: &Ray) -> ObservedAnswer {
    let part = |part: &RayCheck| match part {
        RayCheck::Origin => ray.origin.to_array().to_vec(),
        RayCheck::Direction => (ray.dir / ray.dir.length()).to_array().to_vec(),
        RayCheck::UnitLength => vec![ray.dir.length()],
        RayCheck::Range => vec![ray.range.min, ray.range.max],
    };
    ObservedAnswer::Numbers(judged.iter().flat_map(part).collect())
}

fn observe_hit(judged: &[HitCheck], trace: Option<&Trace>) -> ObservedAnswer {
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
    ObservedAnswer::Numbers(judged.iter().flat_map(part).collect())
}

fn observe_span(span: Option<Interval>) -> ObservedAnswer {
    span.map_or(ObservedAnswer::NoHit, |span| {
        ObservedAnswer::Numbers(vec![span.min, span.max])
    })
}

/// Trees of one mind differ from submission to submission: what is told is what the judge finds.
fn observe_tree(asked: &ExamQuestion, answer: &Answer) -> ObservedAnswer {
    let how = judge(asked, answer).failure.map(|failure| failure.kind);
    match how {
        None => ObservedAnswer::Tree(None),
        Some(FailureKind::Wrong { what, got, .. }) => {
            // Where the finding is a number it comes first. The other numbers are places.
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
