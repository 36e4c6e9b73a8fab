//! A numerical summary of a class, written to `class.json`.

mod attention;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::iter;

use grader::policy::Policy;
use indexmap::{IndexMap, IndexSet};
use serde::Serialize;

use self::attention::outliers;

use crate::distribution::Distribution;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::manual_points::ManualPoints;
use crate::outcome::{EntryOutcome, ItemScore, ScoreSummary, TaskScore};

pub use attention::{Outlier, Reason, attention_groups};

/// The format version of `class.json`.
const SCHEMA: u32 = 1;
/// The maximum number of root causes to list.
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
    /// The isolation level used for the submissions.
    pub isolation: String,
    /// The number of graded submissions.
    pub graded: usize,
    /// The number of submissions with nothing to grade.
    pub nothing_to_grade: usize,
    /// The number of submissions that were not graded because of a problem with the grader or the
    /// machine.
    pub not_graded: usize,
    /// The number of people on the rosters who submitted nothing.
    pub missing: usize,
    /// The number of submissions treated as on time because their time is unknown.
    pub undated: usize,
    /// The number of submissions without final points because their submission time is unclear.
    pub unclear_times: usize,
    /// The number of submissions without final points because they are drafts.
    pub drafts: usize,
    /// The number of submissions without final points because it is unclear who handed them in.
    pub unclear_people: usize,
    /// The number of submissions by people who aren't on the lists.
    pub unlisted: usize,
    /// The number of submissions that aren't used because another submission by the same person
    /// counts.
    pub superseded: usize,
    /// The number of submissions by Canvas's test student that the other numbers leave out.
    pub by_test_student: usize,
    /// The number of submissions that the teacher has yet to choose or reject.
    pub undecided: usize,
    /// The maximum possible final points, which the policy may change. `None` if nobody has final
    /// points.
    pub counts_max: Option<u32>,
    /// The distribution of the total points, or `None` if there are no scores.
    pub points: Option<Distribution>,
    /// The distribution of each task's points, in lecture order.
    pub tasks: Vec<TaskDistribution>,
    /// The number of graded submissions in each section of the roster, and in the whole class under
    /// the name `all`.
    pub sections: BTreeMap<String, usize>,
    /// How often each task and each item was failed, in lecture order.
    pub failed: Vec<FailureRate>,
    /// The most common root causes of lost points, in descending order of the number of
    /// submissions.
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

impl ClassSummary {
    /// Summarises a class. `with_message` contains the indices of the submissions that there are
    /// messages to students about.
    pub fn new(class: &GradedClass, policy: &Policy, with_message: &BTreeSet<usize>) -> Self {
        let scores: Vec<&ScoreSummary> = class.scores().map(|(_, score)| score).collect();
        let max_points = scores.first().map_or(0, |score| score.max_points);
        let points: Vec<u32> = scores.iter().map(|score| score.points).collect();
        let points = Distribution::new(points, max_points);
        let rows = || class.rows.iter().filter(|row| !row.is_of_test_student());
        let count = |is_one: fn(&ClassRow) -> bool| rows().filter(|row| is_one(row)).count();
        let with_status = |status: &str| {
            let has_status =
                |row: &&ClassRow| row.grades.iter().any(|own| row.status(own) == status);
            rows().filter(has_status).count()
        };
        let grades = class.rows.iter().flat_map(|row| &row.grades);
        // Attempts that the teacher has yet to choose from have the same manual points.
        let decisions: IndexSet<&ManualPoints> = grades.flat_map(|grade| &grade.manual).collect();
        let counting = without_ignored_items(class, policy);
        let counting_scores: Vec<&ScoreSummary> = counting.scores().map(|(_, own)| own).collect();
        let (sections, failed) = failure_rates(&counting);
        ClassSummary {
            schema: SCHEMA,
            exam: class.settings.exam.clone(),
            exam_hash: class.settings.exam_hash.clone(),
            isolation: class.settings.isolation.clone(),
            graded: scores.len(),
            nothing_to_grade: count(has_nothing),
            not_graded: class.fault_count(),
            missing: class.missing.len(),
            unclear_times: with_status("time unclear"),
            drafts: with_status("draft"),
            unclear_people: with_status("person unclear"),
            unlisted: count(|row| row.result.info.is_unlisted && !row.is_superseded()),
            superseded: count(ClassRow::is_superseded),
            by_test_student: class.rows.len() - rows().count(),
            undecided: with_status("several attempts"),
            undated: count(|row| row.grades.iter().any(PersonGrade::is_undated)),
            counts_max: class.counts_max(),
            tasks: tasks(&scores),
            sections,
            failed,
            causes: causes(&counting_scores),
            outliers: outliers(class, points.as_ref(), with_message),
            decisions: decisions.into_iter().cloned().collect(),
            points,
        }
    }
}

/// Returns the class without the items that the policy removes and those of tasks that it leaves
/// out.
fn without_ignored_items(class: &GradedClass, policy: &Policy) -> GradedClass {
    let mut class = class.clone();
    for row in &mut class.rows {
        let EntryOutcome::Graded(score) = &mut row.result.outcome else {
            continue;
        };
        let ignored = policy.points.ignored_items(&score.for_policy());
        for task in &mut score.tasks {
            task.items.retain(|item| !ignored.contains(&item.id));
            task.points = task.items.iter().map(|item| item.points).sum();
            task.max_points = task.items.iter().map(|item| item.max_points).sum();
        }
        score.tasks.retain(|task| !task.items.is_empty());
    }
    class
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
    let indices = 0..first.tasks.len();
    indices.filter_map(task_distribution).collect()
}

/// Counts the submissions in each section, and those that failed each task and item.
fn failure_rates(class: &GradedClass) -> (BTreeMap<String, usize>, Vec<FailureRate>) {
    let mut sections = BTreeMap::new();
    let mut rates: IndexMap<&String, BTreeMap<String, usize>> = IndexMap::new();
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
            iter::once((&task.id, task.points < task.max_points)).chain(items)
        });
        for (id, is_failed) in parts {
            let counts = rates.entry(id).or_default();
            for section in &own {
                *counts.entry(section.clone()).or_default() += usize::from(is_failed);
            }
        }
    }
    let rates = rates.into_iter();
    let rates = rates.map(|(id, counts)| FailureRate {
        id: id.clone(),
        counts,
    });
    (sections, rates.collect())
}

fn causes(scores: &[&ScoreSummary]) -> Vec<Cause> {
    let mut causes: BTreeMap<String, Cause> = BTreeMap::new();
    for score in scores {
        let mut found = BTreeSet::new();
        for task in &score.tasks {
            for (text, item) in task_causes(task) {
                let cause = causes.entry(text.clone()).or_insert_with(|| Cause {
                    text: text.clone(),
                    items: BTreeSet::new(),
                    count: 0,
                });
                cause.items.extend(item);
                // Each cause is counted once per submission.
                cause.count += usize::from(found.insert(text));
            }
        }
    }
    let mut causes: Vec<Cause> = causes.into_values().collect();
    causes.sort_by_key(|cause| Reverse(cause.count));
    causes.truncate(MAX_CAUSES);
    causes
}

/// Returns the causes of the points lost in a task. Each cause comes with the item that shows it,
/// unless it concerns the entire task.
fn task_causes(task: &TaskScore) -> Vec<(String, Option<String>)> {
    let is_cause = |item: &&ItemScore| item.points < item.max_points && item.blocked_by.is_none();
    let failed = task.items.iter().filter(is_cause);
    // Only the most likely hint is counted.
    let hint = |item: &ItemScore| Some((item.hints.first()?.hint.clone(), Some(item.id.clone())));
    let known: Vec<_> = failed.clone().filter_map(hint).collect();
    // A known mistake also causes failures in items, such as pictures, that cannot distinguish it
    // from other mistakes.
    if !known.is_empty() {
        return known;
    }
    let id = &task.id;
    let cause = |item: &ItemScore| match item.verdict.as_str() {
        // Several tasks can share a file.
        "not_compiled" => (item.message.clone(), None),
        "unimplemented" => (format!("{id} is not written yet"), None),
        // The rest of the task has the same verdict because it wasn't run.
        "timed_out" => (format!("{id} takes too long"), None),
        "crashed" => (format!("{id} crashes"), None),
        "out_of_memory" => (format!("{id} needs too much memory"), None),
        _ if task.points == 0 && task.items.len() > 1 => (format!("{id} gets no points"), None),
        _ => (item.title.clone(), Some(item.id.clone())),
    };
    failed.map(cause).collect()
}
