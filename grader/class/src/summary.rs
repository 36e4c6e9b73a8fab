//! What a class did, in numbers: pure.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::Serialize;

use crate::distribution::Distribution;
use crate::model::{ClassRow, GradedClass};
use crate::outcome::ScoreSummary;

/// The version of `class.json`.
const SCHEMA: u32 = 1;
/// Of the longest lists, so many lines.
const MAX_ENTRIES: usize = 10;

/// What a class did.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassSummary {
    /// The version of this format.
    pub schema: u32,
    /// The exam's name.
    pub exam: String,
    /// Of its bytes.
    pub exam_hash: String,
    /// How submissions were kept apart from the machine.
    pub isolation: String,
    /// How many were graded.
    pub graded: usize,
    /// How many had nothing that could be graded.
    pub nothing_to_grade: usize,
    /// How many were not graded for reasons of ours or the machine's.
    pub not_graded: usize,
    /// How many of the lists handed in nothing.
    pub missing: usize,
    /// How many count as in time because nobody knows when they came.
    pub undated: usize,
    /// All points. None without a score.
    pub points: Option<Distribution>,
    /// In lecture order.
    pub tasks: Vec<TaskDistribution>,
    /// The items that most have failed, the worst first.
    pub failed_most: Vec<FailedItem>,
    /// The known mistakes that most have made, the commonest first.
    pub mistakes: Vec<MistakeCount>,
    /// Whom a person should look at, and why.
    pub outliers: Vec<Outlier>,
}

/// One task's points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskDistribution {
    /// Such as `sphere`.
    pub id: String,
    /// What people read.
    pub title: String,
    /// How its points spread.
    #[serde(flatten)]
    pub points: Distribution,
}

/// An item that was failed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailedItem {
    /// Such as `sphere.from_inside`.
    pub item: String,
    /// What must hold.
    pub title: String,
    /// How many lack points.
    pub count: usize,
}

/// A mistake that was recognised.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MistakeCount {
    /// What is wrong.
    pub hint: String,
    /// In how many submissions.
    pub count: usize,
}

/// A submission that stands apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// The entry's id.
    pub id: String,
    /// Why.
    pub why: String,
}

impl ClassSummary {
    /// Of a class.
    pub fn new(class: &GradedClass) -> Self {
        let scores: Vec<&ScoreSummary> = class.scores().map(|(_, score)| score).collect();
        let max_points = scores.first().map_or(0, |score| score.max_points);
        let points: Vec<u32> = scores.iter().map(|score| score.points).collect();
        let points = Distribution::new(points, max_points);
        let not_graded = class.fault_count();
        ClassSummary {
            schema: SCHEMA,
            exam: class.exam.clone(),
            exam_hash: class.exam_hash.clone(),
            isolation: class.isolation.clone(),
            graded: scores.len(),
            nothing_to_grade: class.rows.len() - scores.len() - not_graded,
            not_graded,
            missing: class.missing.len(),
            undated: class.rows.iter().filter(|line| line.is_undated).count(),
            tasks: tasks(&scores),
            failed_most: failed_most(&scores),
            mistakes: mistakes(&scores),
            outliers: outliers(class, points.as_ref()),
            points,
        }
    }
}

fn tasks(scores: &[&ScoreSummary]) -> Vec<TaskDistribution> {
    let Some(first) = scores.first() else {
        return Vec::new();
    };
    let spread = |place: usize| {
        let task = &first.tasks[place];
        let points = scores.iter().filter_map(|score| score.tasks.get(place));
        let points = points.map(|task| task.points).collect();
        Some(TaskDistribution {
            id: task.id.clone(),
            title: task.title.clone(),
            points: Distribution::new(points, task.max_points)?,
        })
    };
    (0..first.tasks.len()).filter_map(spread).collect()
}

fn failed_most(scores: &[&ScoreSummary]) -> Vec<FailedItem> {
    // In the order of asking, which settles ties.
    let mut failed: Vec<FailedItem> = Vec::new();
    for item in scores.iter().flat_map(|score| score.items()) {
        let count = usize::from(item.points < item.max_points);
        match failed.iter_mut().find(|failed| failed.item == item.id) {
            Some(failed) => failed.count += count,
            None => failed.push(FailedItem {
                item: item.id.clone(),
                title: item.title.clone(),
                count,
            }),
        }
    }
    failed.retain(|failed| failed.count > 0);
    failed.sort_by_key(|failed| Reverse(failed.count));
    failed.truncate(MAX_ENTRIES);
    failed
}

fn mistakes(scores: &[&ScoreSummary]) -> Vec<MistakeCount> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for score in scores {
        // The likeliest of each item; once, however many items show it.
        let hints = score.items().filter_map(|item| item.hints.first());
        let mut hints: Vec<&str> = hints.map(|hint| hint.hint.as_str()).collect();
        hints.sort_unstable();
        hints.dedup();
        for hint in hints {
            *counts.entry(hint).or_default() += 1;
        }
    }
    let mistake = |(hint, count): (&str, usize)| MistakeCount {
        hint: hint.to_owned(),
        count,
    };
    let mut mistakes: Vec<MistakeCount> = counts.into_iter().map(mistake).collect();
    mistakes.sort_by_key(|mistake| Reverse(mistake.count));
    mistakes.truncate(MAX_ENTRIES);
    mistakes
}

/// Those without a score, those with nothing, and those far below the others (Tukey's fence).
fn outliers(class: &GradedClass, points: Option<&Distribution>) -> Vec<Outlier> {
    let fence = points.map_or(0.0, |points| {
        let (lower, upper) = (points.lower_quartile.into(), points.upper_quartile.into());
        let (lower, upper): (f64, f64) = (lower, upper);
        lower - 1.5 * (upper - lower)
    });
    let why = |line: &ClassRow| match line.result.score() {
        None => Some(format!("{}: {}", line.status(), line.why())),
        Some(score) if score.items().all(|item| item.verdict == "not_compiled") => {
            Some("0 points: nothing compiles".to_owned())
        }
        Some(score) if score.items().all(|item| item.verdict == "unimplemented") => {
            Some("0 points: nothing is written yet".to_owned())
        }
        Some(score) if score.points == 0 => Some("0 points".to_owned()),
        Some(score) if f64::from(score.points) < fence => {
            Some(format!("{} points, far below the others", score.points))
        }
        Some(_) => None,
    };
    let outlier = |line: &ClassRow| {
        Some(Outlier {
            id: line.result.id.clone(),
            why: why(line)?,
        })
    };
    class.rows.iter().filter_map(outlier).collect()
}
