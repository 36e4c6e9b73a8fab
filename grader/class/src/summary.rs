//! The summary of a class in numbers, written to `class.json`.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::distribution::Distribution;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass};
use crate::manual_points::ManualPoints;
use crate::outcome::{EntryOutcome, ScoreSummary, id_and_names};

/// The format version of `class.json`.
const SCHEMA: u32 = 1;
/// The maximum number of root causes that are listed.
const MAX_CAUSES: usize = 20;

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
    /// The number of graded submissions.
    pub graded: usize,
    /// The number of submissions with nothing to grade.
    pub nothing_to_grade: usize,
    /// The number of submissions that were not graded because of the grader or the machine.
    pub not_graded: usize,
    /// The number of people on the rosters who submitted nothing.
    pub missing: usize,
    /// The number of submissions treated as on time because their time is unknown.
    pub undated: usize,
    /// The number of submissions without final points because their submission time is unclear.
    pub unclear_times: usize,
    /// The number of submissions that aren't used because another submission by the same person is.
    pub superseded: usize,
    /// The number of submissions the teacher has yet to choose or reject.
    pub undecided: usize,
    /// The distribution of the total points, or `None` without scores.
    pub points: Option<Distribution>,
    /// The distribution of each task's points, in lecture order.
    pub tasks: Vec<TaskDistribution>,
    /// The number of graded submissions in each section of the roster, and in `all`.
    pub sections: BTreeMap<String, usize>,
    /// How often each task and each item was failed, in lecture order.
    pub failed: Vec<FailureRate>,
    /// The most common root causes of lost points, in descending order of the number of submissions.
    pub causes: Vec<Cause>,
    /// The submissions that need attention.
    pub outliers: Vec<Outlier>,
    /// The manual points and comments.
    pub decisions: Vec<ManualPoints>,
}

/// The distribution of a task's points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskDistribution {
    /// The task's id, such as `sphere`.
    pub id: String,
    /// The task's human-readable title.
    pub title: String,
    /// The distribution of the points.
    #[serde(flatten)]
    pub points: Distribution,
}

/// How often a task or an item was failed, i.e. didn't get full points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailureRate {
    /// The id of the task, such as `sphere`, or of the item, such as `sphere.from_inside`.
    pub id: String,
    /// The number of submissions that failed it, in each section.
    pub counts: BTreeMap<String, usize>,
}

/// A root cause of lost points. Failures that only follow from another failure are not root causes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cause {
    /// The hint for the known mistake, or else the requirement that isn't met.
    pub text: String,
    /// The items that failed because of it. Empty if the entire task failed.
    pub items: BTreeSet<String>,
    /// The number of submissions.
    pub count: usize,
}

/// A submission that needs attention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// The entry's id.
    pub id: String,
    /// The names of its people.
    pub names: String,
    /// Why the submission needs attention.
    pub why: String,
    /// Whether the submission has a report.
    #[serde(skip)]
    pub has_report: bool,
}

impl Outlier {
    /// Returns the id and, if they differ from it, the names of the people.
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
        let (sections, failed) = failure_rates(class);
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
            sections,
            failed,
            causes: causes(&scores),
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

/// Counts the submissions of each section and those that failed each task and item.
fn failure_rates(class: &GradedClass) -> (BTreeMap<String, usize>, Vec<FailureRate>) {
    let mut sections = BTreeMap::new();
    let mut rates: Vec<FailureRate> = Vec::new();
    for (result, score) in class.scores() {
        let own = result.info.people.iter().map(|person| &person.section);
        let own = own.filter(|section| !section.is_empty()).cloned();
        let own: BTreeSet<String> = own.chain(["all".to_owned()]).collect();
        for section in &own {
            *sections.entry(section.clone()).or_default() += 1;
        }
        let parts = score.tasks.iter().flat_map(|task| {
            let items = task.items.iter();
            let items = items.map(|item| (&item.id, item.points < item.max_points));
            [(&task.id, task.points < task.max_points)]
                .into_iter()
                .chain(items)
        });
        for (id, is_failed) in parts {
            let known = rates.iter().position(|rate| rate.id == *id);
            let known = known.unwrap_or_else(|| {
                let (id, counts) = (id.clone(), BTreeMap::new());
                rates.push(FailureRate { id, counts });
                rates.len() - 1
            });
            for section in &own {
                let count = rates[known].counts.entry(section.clone());
                *count.or_default() += usize::from(is_failed);
            }
        }
    }
    (sections, rates)
}

fn causes(scores: &[&ScoreSummary]) -> Vec<Cause> {
    let mut causes: BTreeMap<String, Cause> = BTreeMap::new();
    for score in scores {
        let mut found = BTreeSet::new();
        for item in score.items() {
            if item.points == item.max_points || item.blocked_by.is_some() {
                continue;
            }
            let task = item.id.split('.').next().unwrap_or_default();
            // Only the most likely hint is counted.
            let (text, own) = match (item.hints.first(), item.verdict.as_str()) {
                (Some(hint), _) => (hint.hint.clone(), Some(&item.id)),
                (None, "not_compiled") => (format!("{task} does not compile"), None),
                (None, "unimplemented") => (format!("{task} is not written yet"), None),
                // The rest of the task has the same verdict because it wasn't run.
                (None, "timed_out") => (format!("{task} takes too long"), None),
                (None, "crashed") => (format!("{task} ends the program"), None),
                (None, "out_of_memory") => (format!("{task} needs too much memory"), None),
                (None, _) => (item.title.clone(), Some(&item.id)),
            };
            let cause = causes.entry(text.clone()).or_insert_with(|| Cause {
                text: text.clone(),
                items: BTreeSet::new(),
                count: 0,
            });
            cause.items.extend(own.cloned());
            // Each cause is counted once per submission.
            cause.count += usize::from(found.insert(text));
        }
    }
    let mut causes: Vec<Cause> = causes.into_values().collect();
    causes.sort_by_key(|cause| Reverse(cause.count));
    causes.truncate(MAX_CAUSES);
    causes
}

/// Returns the submissions without a score, without points, far below the others (Tukey's fence),
/// or with files that look like task files but were not graded.
fn outliers(class: &GradedClass, points: Option<&Distribution>) -> Vec<Outlier> {
    let fence = points.map_or(0.0, |points| {
        let (lower, upper) = (points.lower_quartile.into(), points.upper_quartile.into());
        let (lower, upper): (f64, f64) = (lower, upper);
        lower - 1.5 * (upper - lower)
    });
    let problem = |row: &ClassRow| {
        let grade = row.grades.iter().find(|grade| grade.counted.is_none())?;
        let advice = match (&row.result.outcome, &grade.problem) {
            (EntryOutcome::NothingToGrade(_), None) if row.result.info.needs_staff => {
                "; or give points by hand"
            }
            (EntryOutcome::NothingToGrade(_), None) => {
                "; ask for the files, with the text in hand-in-again, or give points by hand"
            }
            (EntryOutcome::Fault(_), _) => "; run this again",
            (_, _) => "",
        };
        Some(format!("{}: {}{advice}", row.status(grade), row.why(grade)))
    };
    let why = |row: &ClassRow| match row.result.score() {
        _ if row.is_superseded() => None,
        None => problem(row),
        Some(_) if row.problem().is_some() => problem(row),
        Some(score) if score.items().all(|item| item.verdict == "not_compiled") => {
            Some("0 points: nothing compiles; the report has the errors".to_owned())
        }
        Some(score) if score.items().all(|item| item.verdict == "unimplemented") => {
            Some("0 points: nothing is written yet; ask for the right files".to_owned())
        }
        Some(score) if score.points == 0 => Some("0 points; read the report".to_owned()),
        Some(score) if f64::from(score.points) < fence => Some(format!(
            "{} points, far below the others; read the report",
            score.points
        )),
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
