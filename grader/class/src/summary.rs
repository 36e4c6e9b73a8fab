//! The summary of a class in numbers, which is written to `class.json`.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::Serialize;

use crate::distribution::Distribution;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass};
use crate::manual_points::ManualPoints;
use crate::outcome::{EntryOutcome, ScoreSummary, id_and_names};

/// The format version of `class.json`.
const SCHEMA: u32 = 1;
/// The maximum number of failed items and of mistakes that are listed.
const MAX_ENTRIES: usize = 10;

/// The contents of `class.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassSummary {
    /// The format version.
    pub schema: u32,
    /// The exam's name.
    pub exam: String,
    /// The hash of the exam file.
    pub exam_hash: String,
    /// The isolation level of the submissions.
    pub isolation: String,
    /// The number of submissions that were graded.
    pub graded: usize,
    /// The number of submissions with nothing to grade.
    pub nothing_to_grade: usize,
    /// The number of submissions that were not graded because of the grader or the machine.
    pub not_graded: usize,
    /// The number of people on the rosters who submitted nothing.
    pub missing: usize,
    /// The number of submissions that count as on time because their time is unknown.
    pub undated: usize,
    /// The number of submissions without final points because their submission time is unclear.
    pub unclear_times: usize,
    /// The number of submissions that do not count because another one of the same person does.
    pub superseded: usize,
    /// The number of submissions of which nobody has chosen whether they count.
    pub undecided: usize,
    /// The distribution of the total points; `None` if there are no scores.
    pub points: Option<Distribution>,
    /// The distribution of each task's points, in lecture order.
    pub tasks: Vec<TaskDistribution>,
    /// The items that were failed most often, in descending order of the number of submissions.
    pub failed_most: Vec<FailedItem>,
    /// The most common known mistakes, in descending order of the number of submissions.
    pub mistakes: Vec<MistakeCount>,
    /// The submissions that need attention.
    pub outliers: Vec<Outlier>,
    /// The points and comments by hand.
    pub decisions: Vec<ManualPoints>,
}

/// The distribution of a task's points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskDistribution {
    /// The task's id, such as `sphere`.
    pub id: String,
    /// The task's title, as it is shown to people.
    pub title: String,
    /// The distribution of the points.
    #[serde(flatten)]
    pub points: Distribution,
}

/// An item that some submissions failed, which means that they did not get its full points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailedItem {
    /// The item's id, such as `sphere.from_inside`.
    pub item: String,
    /// The item's title: a sentence that describes the correct behaviour.
    pub title: String,
    /// The number of submissions that did not get full points for this item.
    pub count: usize,
}

/// A known mistake that was recognised in some submissions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MistakeCount {
    /// The text of the mistake's hint.
    pub hint: String,
    /// The number of submissions with this mistake.
    pub count: usize,
}

/// A submission that needs attention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// The entry's id.
    pub id: String,
    /// The names of its people.
    pub names: String,
    /// The reason why the submission needs attention.
    pub why: String,
    /// Whether there is a report on it.
    #[serde(skip)]
    pub has_report: bool,
}

impl Outlier {
    /// Returns the id and, if they are others, the names of the people.
    pub fn title(&self) -> String {
        id_and_names(&self.id, &self.names)
    }
}

impl ClassSummary {
    /// Summarises a class.
    pub fn new(class: &GradedClass) -> Self {
        let scores: Vec<&ScoreSummary> = class.scores().map(|(_, score)| score).collect();
        let max_points = scores.first().map_or(0, |score| score.max_points);
        let points: Vec<u32> = scores.iter().map(|score| score.points).collect();
        let points = Distribution::new(points, max_points);
        let count = |is_one: fn(&ClassRow) -> bool| {
            let rows = class.rows.iter();
            rows.filter(|row| is_one(row)).count()
        };
        let grades = class.rows.iter().flat_map(|row| &row.grades);
        ClassSummary {
            schema: SCHEMA,
            exam: class.exam.clone(),
            exam_hash: class.exam_hash.clone(),
            isolation: class.isolation.clone(),
            graded: scores.len(),
            nothing_to_grade: count(has_nothing),
            not_graded: class.fault_count(),
            missing: class.missing.len(),
            unclear_times: count(|row| matches!(row.problem(), Some(GradeProblem::UnclearTime(_)))),
            superseded: count(ClassRow::is_superseded),
            undecided: count(|row| matches!(row.problem(), Some(GradeProblem::SeveralAttempts(_)))),
            undated: count(|row| row.grades.iter().any(|grade| grade.is_undated)),
            tasks: tasks(&scores),
            failed_most: failed_most(&scores),
            mistakes: mistakes(&scores),
            outliers: outliers(class, points.as_ref()),
            decisions: grades.flat_map(|grade| &grade.manual).cloned().collect(),
            points,
        }
    }
}

fn has_nothing(row: &ClassRow) -> bool {
    matches!(row.result.outcome, EntryOutcome::NothingToGrade(_)) && !row.is_superseded()
}

fn tasks(scores: &[&ScoreSummary]) -> Vec<TaskDistribution> {
    let Some(first) = scores.first() else {
        return Vec::new();
    };
    let task_distribution = |index: usize| {
        let task = &first.tasks[index];
        let points = scores.iter().filter_map(|score| score.tasks.get(index));
        let points = points.map(|task| task.points).collect();
        Some(TaskDistribution {
            id: task.id.clone(),
            title: task.title.clone(),
            points: Distribution::new(points, task.max_points)?,
        })
    };
    (0..first.tasks.len())
        .filter_map(task_distribution)
        .collect()
}

fn failed_most(scores: &[&ScoreSummary]) -> Vec<FailedItem> {
    // The items are collected in the order of the exam, which the stable sort below keeps for equal
    // counts.
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
        // Only the most likely hint of each item counts, and each hint counts once per submission.
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

/// Returns the submissions without a score, without points, far below the others (Tukey's fence), or
/// with files that look like task files and were not graded.
fn outliers(class: &GradedClass, points: Option<&Distribution>) -> Vec<Outlier> {
    let fence = points.map_or(0.0, |points| {
        let (lower, upper) = (points.lower_quartile.into(), points.upper_quartile.into());
        let (lower, upper): (f64, f64) = (lower, upper);
        lower - 1.5 * (upper - lower)
    });
    let problem = |row: &ClassRow| {
        let grade = row.grades.iter().find(|grade| grade.counted.is_none())?;
        Some(format!("{}: {}", row.status(grade), row.why(grade)))
    };
    let why = |row: &ClassRow| match row.result.score() {
        _ if row.is_superseded() => None,
        None => problem(row),
        Some(_) if row.problem().is_some() => problem(row),
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
    let outlier = |row: &ClassRow| {
        let copies = row.result.ignored_copies().iter().cloned();
        let copies = copies.filter(|_| !row.is_superseded());
        let all: Vec<String> = why(row).into_iter().chain(copies).collect();
        (!all.is_empty()).then(|| Outlier {
            id: row.result.id.clone(),
            names: row.result.info.display_names(),
            why: all.join("; "),
            has_report: row.result.score().is_some(),
        })
    };
    class.rows.iter().filter_map(outlier).collect()
}
