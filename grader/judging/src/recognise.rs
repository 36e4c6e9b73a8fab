//! From which known mistake a wrong answer comes, if that can be told.
//!
//! A mistake explains an item if it answers all the elements that the key tells of as the
//! submission did. It is only named if it explains every item of the task that it gets wrong: no
//! hint is better than a false one. What else is wrong may have another reason. Of several mistakes
//! the one that explains most items comes first; where two explain the same, both are named.

use std::collections::BTreeMap;

use protocol::{Answer, Interval, Outcome, Ray, Trace};

use crate::exam::{Asked, Exam, Hit, Item, Key, Part, RayPart, Task};
use crate::judge::{How, judge};
use crate::tells::{KnownMistake, Seen, Silence, Told};

/// The most mistakes that are named together. More than that is no hint.
const MOST: usize = 3;

/// What was seen of a submission's answers to the elements that the keys tell of, by item.
#[derive(Clone, Debug, Default)]
pub struct Sightings(BTreeMap<String, Vec<Seen>>);

impl Sightings {
    /// Notes the answers to an item, or why there were none.
    pub fn note(&mut self, item: &Item, answers: Result<&[Answer], Silence>) {
        if item.tells.elements.is_empty() {
            return;
        }
        let seen = match answers {
            Ok(answers) => {
                let all = see_all(item, answers);
                let told = item.tells.elements.iter();
                told.map(|&element| {
                    all.get(element as usize)
                        .cloned()
                        .unwrap_or(Seen::NoAnswer(Silence::Other))
                })
                .collect()
            }
            Err(why) => vec![Seen::NoAnswer(why); item.tells.elements.len()],
        };
        self.0.insert(item.id.clone(), seen);
    }

    /// The known mistakes that explain an item, the likeliest, or several that nothing tells apart.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let Some(seen) = self.0.get(&item.id) else {
            return Vec::new();
        };
        if self.is_mute(exam, item.task) {
            return Vec::new();
        }
        let told = item
            .tells
            .wrong
            .iter()
            .filter(|told| explains(item, told, seen));
        let candidates = told.flat_map(|told| &told.by);
        let explained: Vec<(u32, usize)> = candidates
            .filter_map(|&mistake| Some((mistake, self.explained(exam, item.task, mistake)?)))
            .collect();
        let Some(most) = explained.iter().map(|(_, count)| *count).max() else {
            return Vec::new();
        };
        let best = explained.iter().filter(|(_, count)| *count == most);
        let best: Vec<&KnownMistake> = best
            .filter_map(|(mistake, _)| exam.mistakes.get(*mistake as usize))
            .collect();
        if best.len() > MOST { Vec::new() } else { best }
    }

    /// Whether there is nothing to go by in a whole task: no right answer, and no wrong one either.
    fn is_mute(&self, exam: &Exam, task: Task) -> bool {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut seen = items.filter_map(|item| self.0.get(&item.id)).flatten();
        seen.all(Seen::is_mute)
    }

    /// How many items of a task a mistake explains; none if something speaks against it.
    fn explained(&self, exam: &Exam, task: Task, mistake: u32) -> Option<usize> {
        let items = exam.items.iter().filter(|item| item.task == task);
        let mut count = 0;
        for item in items {
            let mut told = item.tells.wrong.iter();
            let told = told.find(|told| told.by.contains(&mistake));
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
fn explains(item: &Item, told: &Told, seen: &[Seen]) -> bool {
    let mut wrong = told.answers.iter().peekable();
    seen.iter()
        .zip(&item.tells.right)
        .enumerate()
        .all(
            |(place, (seen, right))| match wrong.next_if(|(other, _)| *other as usize == place) {
                Some((_, answer)) => seen.is_like(answer),
                None => seen.is_like(right),
            },
        )
}

/// What is seen of each element of an item's answers.
pub fn see_all(item: &Item, answers: &[Answer]) -> Vec<Seen> {
    let asked = item.questions.iter().zip(answers);
    asked
        .flat_map(|(asked, answer)| see(asked, answer))
        .collect()
}

/// What a right answer shows, of each element of an item.
pub fn right(item: &Item) -> Vec<Seen> {
    item.questions.iter().flat_map(right_elements).collect()
}

fn right_elements(asked: &Asked) -> Vec<Seen> {
    match &asked.key {
        Key::Rays { judged, directions } => {
            let ray = |dir| Ray {
                origin: glam::Vec3::ZERO,
                dir,
                range: Interval::AHEAD,
            };
            directions
                .iter()
                .map(|&dir| of_ray(judged, &ray(dir)))
                .collect()
        }
        Key::Hits { judged, hits } => {
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
            let trace = |hit: &Hit, ray: &Ray| Trace {
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
            traces.map(|trace| of_hit(judged, trace.as_ref())).collect()
        }
        Key::Spans { spans } => spans.iter().map(|span| of_span(*span)).collect(),
        Key::Tree { .. } => vec![Seen::Tree(None)],
        Key::FirstHits { .. } | Key::Radiance { .. } => Vec::new(),
    }
}

fn see(asked: &Asked, answer: &Answer) -> Vec<Seen> {
    match (&asked.key, answer) {
        (Key::Rays { judged, .. }, Answer::Rays(rays)) => each(rays, |ray| of_ray(judged, ray)),
        (Key::Hits { judged, .. }, Answer::Hits(hits)) => {
            each(hits, |hit| of_hit(judged, hit.as_ref()))
        }
        (Key::Spans { .. }, Answer::Spans(spans)) => each(spans, |span| of_span(*span)),
        (Key::Tree { .. }, Answer::Tree(tree)) => {
            each(std::slice::from_ref(tree), |_| of_tree(asked, answer))
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

fn each<T>(outcomes: &[Outcome<T>], see: impl Fn(&T) -> Seen) -> Vec<Seen> {
    let seen = outcomes.iter().map(|outcome| match outcome {
        Outcome::Value(value) => see(value),
        Outcome::Panicked(_) | Outcome::GivenUp => Seen::Panicked,
    });
    seen.collect()
}

fn of_ray(judged: &[RayPart], ray: &Ray) -> Seen {
    let part = |part: &RayPart| match part {
        RayPart::Origin => ray.origin.to_array().to_vec(),
        RayPart::Direction => (ray.dir / ray.dir.length()).to_array().to_vec(),
        RayPart::UnitLength => vec![ray.dir.length()],
        RayPart::Range => vec![ray.range.min, ray.range.max],
    };
    Seen::Numbers(judged.iter().flat_map(part).collect())
}

fn of_hit(judged: &[Part], trace: Option<&Trace>) -> Seen {
    let Some(trace) = trace else {
        return Seen::Nothing;
    };
    let part = |part: &Part| match part {
        Part::Distance => vec![trace.distance],
        Part::Position => trace.position.to_array().to_vec(),
        Part::Normal => (trace.normal / trace.normal.length()).to_array().to_vec(),
        Part::UnitNormal => vec![trace.normal.length()],
        Part::Uv => trace.uv.to_array().to_vec(),
        Part::Origin => trace.origin.to_array().to_vec(),
        Part::Material => vec![trace.material as f32],
    };
    Seen::Numbers(judged.iter().flat_map(part).collect())
}

fn of_span(span: Option<Interval>) -> Seen {
    span.map_or(Seen::Nothing, |span| {
        Seen::Numbers(vec![span.min, span.max])
    })
}

/// Trees of one mind differ from submission to submission: what is told is what the judge finds.
fn of_tree(asked: &Asked, answer: &Answer) -> Seen {
    let how = judge(asked, answer).failure.map(|failure| failure.how);
    match how {
        None => Seen::Tree(None),
        Some(How::Wrong { what, got, .. }) => {
            // Where the finding is a number it comes first. The other numbers are places.
            let amount = got.split(' ').next().and_then(|word| word.parse().ok());
            let is_word = |word: &&str| !word.contains(|c: char| c.is_ascii_digit());
            let words: Vec<&str> = got.split(' ').filter(is_word).collect();
            let found = format!("{what}: {}", words.join(" "));
            Seen::Tree(Some((found, amount.unwrap_or(0.0))))
        }
        Some(How::Panicked(_)) => Seen::Panicked,
        Some(How::Protocol(_)) => Seen::NoAnswer(Silence::Other),
    }
}
