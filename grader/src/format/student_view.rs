//! The part of a score that students may see. All formats are rendered from it.

use judging::assignment::Task;

use crate::policy::{CountedPoints, Lateness, Policy, Visibility};
use crate::rerun_command::RerunCommand;
use crate::score::{ItemScore, Score, TaskScore, Verdict};

/// A score without the parts that the policy hides, and without notes for staff.
#[derive(Clone, Debug)]
pub struct StudentView {
    /// The score as students may see it now. The hidden items of each task are summed up in a
    /// single item.
    pub visible: Score,
    /// All items, for platforms that can show some of them later.
    pub all_items: Vec<ItemView>,
    /// The points that count in the course.
    pub counted: CountedPoints,
}

/// An item, and when students may see it.
#[derive(Clone, Debug)]
pub struct ItemView {
    /// The task of the item.
    pub task: Task,
    /// The item, without the parts that the policy hides.
    pub item: ItemScore,
    /// When students may see the item.
    pub visibility: Visibility,
}

impl StudentView {
    /// Creates the view that a policy allows.
    pub fn new(score: &Score, policy: &Policy, lateness: Lateness) -> Self {
        let mut visible = score.clone();
        // Students run the grader again on their own machines, where their own submission is the
        // default.
        visible.rerun_command = RerunCommand::default();
        let mut all_items = Vec::new();
        for task in &mut visible.tasks {
            let is_open =
                |item: &ItemScore| policy.visibility(&score.exam, &item.id) == Visibility::All;
            // Printed text may reveal the questions.
            if !task.items.iter().all(is_open) {
                task.printed = None;
            }
            for item in &task.items {
                let visibility = policy.visibility(&score.exam, &item.id);
                all_items.push(ItemView {
                    task: task.id,
                    item: redact(item, visibility, &hidden_ids(policy, score)),
                    visibility,
                });
            }
            task.items = items_shown_now(task, &all_items);
        }
        StudentView {
            visible,
            all_items,
            counted: policy.counted_points(score.points, score.max_points, lateness),
        }
    }

    /// Returns the items that students may see now, each with its task.
    pub fn visible_items(&self) -> impl Iterator<Item = (&TaskScore, &ItemScore)> {
        let tasks = self.visible.tasks.iter();
        tasks.flat_map(|task| task.items.iter().map(move |item| (task, item)))
    }

    /// Returns a notice if grading is not complete.
    pub fn unfinished_notice(&self) -> Option<String> {
        let all = self.all_items.len();
        let graded = self
            .all_items
            .iter()
            .filter(|entry| entry.item.verdict != Verdict::Pending);
        (!self.visible.complete).then(|| {
            format!(
                "UNFINISHED: {} of {all} items are graded; the others have no points yet",
                graded.count()
            )
        })
    }

    /// Returns whether none of the submission's task files compiled.
    pub fn nothing_compiled(&self) -> bool {
        let mut items = self.all_items.iter();
        items.all(|entry| entry.item.verdict == Verdict::NotCompiled)
    }
}

/// Returns the ids of the items that students may not see now.
fn hidden_ids(policy: &Policy, score: &Score) -> Vec<String> {
    let items = score.items();
    let hidden = items.filter(|item| !policy.visibility(&score.exam, &item.id).is_shown_now());
    hidden.map(|item| item.id.clone()).collect()
}

/// Removes everything from an item that students may not see at this visibility, including the ids
/// of `hidden` items.
fn redact(item: &ItemScore, visibility: Visibility, hidden: &[String]) -> ItemScore {
    let mut item = ItemScore {
        staff: None,
        ..item.clone()
    };
    if let Verdict::Blocked { by } = &item.verdict
        && hidden.contains(by)
    {
        let by = by.split('.').next().unwrap_or_default().to_owned();
        item.verdict = Verdict::Blocked { by };
    }
    if let Some(named) = hidden.iter().find(|id| item.message.contains(*id)) {
        let task = named.split('.').next().unwrap_or_default();
        item.message = format!("depends on the task {task}");
    }
    match visibility {
        Visibility::All => item,
        Visibility::Feedback | Visibility::AfterDue | Visibility::AfterPublished => {
            // The submission chooses the message of a panic, which may repeat the question.
            if item.verdict == Verdict::Panicked || item.message.starts_with("panicked") {
                item.message = "panicked".to_owned();
            }
            ItemScore {
                evidence: None,
                pictures: Vec::new(),
                ..item
            }
        }
        Visibility::Points | Visibility::Hidden => redact_to_points(item),
    }
}

/// Keeps only the id, the title and the points of an item, with a verdict that follows from the
/// points.
fn redact_to_points(item: ItemScore) -> ItemScore {
    ItemScore {
        verdict: if item.verdict == Verdict::Pending {
            Verdict::Pending
        } else {
            verdict_from_points(item.points, item.max_points)
        },
        message: String::new(),
        at: None,
        look: None,
        section: None,
        hints: Vec::new(),
        evidence: None,
        carried_forward: false,
        pictures: Vec::new(),
        ..item
    }
}

fn verdict_from_points(points: u32, max_points: u32) -> Verdict {
    match points {
        0 => Verdict::Wrong,
        _ if points < max_points => Verdict::Partial,
        _ => Verdict::Pass,
    }
}

/// Returns the items of a task that students may see now, and one item that sums up the others.
fn items_shown_now(task: &TaskScore, entries: &[ItemView]) -> Vec<ItemScore> {
    let of_task = || entries.iter().filter(|entry| entry.task == task.id);
    let open = of_task().filter(|entry| entry.visibility.is_shown_now());
    let mut items: Vec<ItemScore> = open.map(|entry| entry.item.clone()).collect();
    let hidden: Vec<&ItemScore> = of_task()
        .filter(|entry| !entry.visibility.is_shown_now())
        .map(|entry| &entry.item)
        .collect();
    let Some(first) = hidden.first() else {
        return items;
    };
    let is_pending = hidden.iter().any(|item| item.verdict == Verdict::Pending);
    let points = hidden.iter().map(|item| item.points).sum();
    let max_points = hidden.iter().map(|item| item.max_points).sum();
    items.push(ItemScore {
        id: format!("{}.not_shown", task.id),
        title: match hidden.len() {
            1 => "one item that is not shown".to_owned(),
            count => format!("{count} items that are not shown"),
        },
        points,
        max_points,
        verdict: if is_pending {
            Verdict::Pending
        } else {
            verdict_from_points(points, max_points)
        },
        ..redact_to_points((*first).clone())
    });
    items
}
