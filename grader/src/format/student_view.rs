//! What students may see of a score: all that any format is made of.

use crate::exam::Task;
use crate::policy::{CountedPoints, Lateness, Policy, Visibility};
use crate::rerun_command::RerunCommand;
use crate::score::{ItemScore, Score, TaskScore, Verdict};

/// A score without what the policy hides, and without what is the staff's.
#[derive(Clone, Debug)]
pub struct StudentView {
    /// What may be seen now. The items of a task that may not are one line.
    pub visible: Score,
    /// Every item, for a platform that shows some of them later.
    pub all_items: Vec<ItemView>,
    /// What it counts for.
    pub counted: CountedPoints,
}

/// One item, and who may see it when.
#[derive(Clone, Debug)]
pub struct ItemView {
    /// Whose points it counts for.
    pub task: Task,
    /// Without what the policy hides.
    pub item: ItemScore,
    /// When it may be seen.
    pub visibility: Visibility,
}

impl StudentView {
    /// What this policy lets students see.
    pub fn new(score: &Score, policy: &Policy, lateness: Lateness) -> Self {
        let mut now = score.clone();
        // On their own machine they ask their own submission.
        now.rerun_command = RerunCommand::default();
        let mut later = Vec::new();
        for task in &mut now.tasks {
            let is_open =
                |item: &ItemScore| policy.visibility(&score.exam, &item.id) == Visibility::All;
            // What code prints while it is asked may tell what it was asked.
            if !task.items.iter().all(is_open) {
                task.printed = None;
            }
            for item in &task.items {
                let visibility = policy.visibility(&score.exam, &item.id);
                later.push(ItemView {
                    task: task.id,
                    item: redact(item, visibility, &hidden_ids(policy, score)),
                    visibility,
                });
            }
            task.items = items_shown_now(task, &later);
        }
        StudentView {
            visible: now,
            all_items: later,
            counted: policy.counted_points(score.points, score.max_points, lateness),
        }
    }

    /// All lines that may be seen now, each with its task.
    pub fn visible_items(&self) -> impl Iterator<Item = (&TaskScore, &ItemScore)> {
        let tasks = self.visible.tasks.iter();
        tasks.flat_map(|task| task.items.iter().map(move |item| (task, item)))
    }

    /// What to say as long as not everything has been asked.
    pub fn unfinished_notice(&self) -> Option<String> {
        let all = self.all_items.len();
        let asked = self
            .all_items
            .iter()
            .filter(|line| line.item.verdict != Verdict::Pending);
        (!self.visible.complete).then(|| {
            format!(
                "UNFINISHED: {} of {all} items were asked; the others have no points yet",
                asked.count()
            )
        })
    }

    /// Whether no file of the submission could be compiled.
    pub fn nothing_compiled(&self) -> bool {
        let all = crate::given_files::TASK_FILES.len();
        self.visible.build.not_compiled.len() == all
    }
}

/// The ids of the items that can not be seen now.
fn hidden_ids(policy: &Policy, score: &Score) -> Vec<String> {
    let items = score.items();
    let hidden = items.filter(|item| !policy.visibility(&score.exam, &item.id).is_shown_now());
    hidden.map(|item| item.id.clone()).collect()
}

/// The item, as far as it may be seen when it may be seen.
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
        item.message = format!("rests on the task {task}");
    }
    match visibility {
        Visibility::All => item,
        Visibility::Feedback | Visibility::AfterDue | Visibility::AfterPublished => {
            // A panic's words are the submission's: they may repeat the question.
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

/// Title and points.
fn redact_to_points(item: ItemScore) -> ItemScore {
    ItemScore {
        verdict: match item.verdict {
            Verdict::Pending => Verdict::Pending,
            Verdict::Pass
            | Verdict::Partial
            | Verdict::Wrong
            | Verdict::Panicked
            | Verdict::Unimplemented
            | Verdict::TimedOut
            | Verdict::OutOfMemory
            | Verdict::Crashed
            | Verdict::Protocol
            | Verdict::NotCompiled
            | Verdict::Blocked { .. } => verdict_from_points(item.points, item.max_points),
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

/// The items of a task that may be seen now, and one line for all that may not.
fn items_shown_now(task: &TaskScore, lines: &[ItemView]) -> Vec<ItemScore> {
    let of_task = || lines.iter().filter(|line| line.task == task.id);
    let open = of_task().filter(|line| line.visibility.is_shown_now());
    let mut items: Vec<ItemScore> = open.map(|line| line.item.clone()).collect();
    let hidden: Vec<&ItemScore> = of_task()
        .filter(|line| !line.visibility.is_shown_now())
        .map(|line| &line.item)
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
        verdict: match is_pending {
            true => Verdict::Pending,
            false => verdict_from_points(points, max_points),
        },
        ..redact_to_points((*first).clone())
    });
    items
}
