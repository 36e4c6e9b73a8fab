//! The part of a score that students may see, with sanitized text. All formats are rendered from
//! it.

use std::collections::BTreeSet;

use crate::format::item_view::{ItemView, shows_everything};
use crate::format::redact::{redact, visible_score};
use crate::policy::{FinalPoints, ItemPoints, Lateness, Policy, TaskPoints, Visibility};
use crate::score::{ItemScore, Score, TaskScore, Timings, Verdict};

/// A score without the parts that the policy hides, and without notes for staff.
#[derive(Clone, Debug)]
pub struct StudentView {
    /// The score as students may see it now. The hidden items of each task are combined into a
    /// single item.
    pub visible: Score,
    /// All items, for platforms that can show some of them later.
    pub all_items: Vec<ItemView>,
    /// The final points in the course.
    pub counted: FinalPoints,
    /// The ids of the items that cost final points, including those that students may not see.
    pub failing: BTreeSet<String>,
}

impl StudentView {
    /// Creates the view that a policy allows.
    pub fn new(score: &Score, policy: &Policy, lateness: Lateness) -> Self {
        let hidden = hidden_ids(policy, score);
        let mut all_items = Vec::new();
        for task in &score.tasks {
            let is_open = is_open(task, policy, score);
            all_items.extend(task.items.iter().map(|item| {
                let mut visibility = policy.visibility(&score.exam, &item.id);
                if visibility == Visibility::All && !is_open {
                    visibility = Visibility::Feedback;
                }
                ItemView {
                    task: task.id,
                    item: redact(item, visibility, &hidden),
                    visibility,
                }
            }));
        }
        let tasks = task_points(score);
        StudentView {
            visible: visible_score(score, &all_items),
            all_items,
            counted: policy.count(&tasks, lateness),
            failing: policy.points.failing_items(&tasks),
        }
    }

    /// Returns the items that students may see now, each with its task.
    pub fn visible_items(&self) -> impl Iterator<Item = (&TaskScore, &ItemScore)> {
        let tasks = self.visible.tasks.iter();
        tasks.flat_map(|task| task.items.iter().map(move |item| (task, item)))
    }

    /// Returns a sentence that explains how the points contribute to the grade, or `None` if they
    /// are used unchanged.
    pub fn counted_text(&self) -> Option<String> {
        self.counted.explanation_if_changed()
    }

    /// Returns how long grading took, in milliseconds. Returns `None` if some questions are hidden
    /// from students: a program could leak information about them through this number by waiting.
    pub fn milliseconds(&self) -> Option<u64> {
        let Timings {
            build_ms, exam_ms, ..
        } = self.visible.timings;
        shows_everything(&self.all_items).then_some(build_ms + exam_ms)
    }

    /// Returns a notice if grading isn't complete.
    pub fn unfinished_notice(&self) -> Option<String> {
        let all = self.all_items.len();
        let graded = self
            .all_items
            .iter()
            .filter(|entry| entry.item.verdict != Verdict::Pending);
        let mut visibilities = self.all_items.iter().map(|entry| entry.visibility);
        let count = if visibilities.all(Visibility::is_shown_now) {
            format!("{} of {all}", graded.count())
        } else {
            "only some".to_owned()
        };
        (!self.visible.complete).then(|| {
            format!("UNFINISHED: {count} items have been graded; the others have no points yet")
        })
    }

    /// Returns whether none of the submission's task files compiled.
    pub fn nothing_compiled(&self) -> bool {
        let mut items = self.all_items.iter();
        items.all(|entry| entry.item.verdict == Verdict::NotCompiled)
    }
}

/// Returns the points that the policy is applied to.
fn task_points(score: &Score) -> Vec<TaskPoints<'_>> {
    let tasks = score.tasks.iter().map(|task| TaskPoints {
        id: task.id.id(),
        points: task.points,
        max_points: task.max_points,
        manual: 0,
        items: task.items.iter().map(item_points).collect(),
    });
    tasks.collect()
}

fn item_points(item: &ItemScore) -> ItemPoints<'_> {
    let blocked_by = if let Verdict::Blocked { by } = &item.verdict {
        Some(by.as_str())
    } else {
        None
    };
    ItemPoints {
        id: &item.id,
        points: item.points,
        max_points: item.max_points,
        blocked_by,
    }
}

/// Returns whether students may see everything about all items of a task. If even one item is
/// restricted, students don't see everything about the others either: one process answers the whole
/// task, so its answer to an open item can repeat a question from another item.
fn is_open(task: &TaskScore, policy: &Policy, score: &Score) -> bool {
    let mut items = task.items.iter();
    items.all(|item| policy.visibility(&score.exam, &item.id) == Visibility::All)
}

/// Returns the ids of the items that students may not see now.
fn hidden_ids(policy: &Policy, score: &Score) -> Vec<String> {
    let items = score.items();
    let hidden = items.filter(|item| !policy.visibility(&score.exam, &item.id).is_shown_now());
    hidden.map(|item| item.id.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::tests::sample;

    /// Returns the students' view of the sample, treated as the score of a final exam. `items`
    /// lists the exceptions to full visibility.
    fn view(items: &str) -> StudentView {
        let policy = format!("[visibility]\nfinal = 'all'\n[visibility.items]\n{items}");
        sample::view(&sample::of_final_exam(sample::score()), &policy, 0)
    }

    fn visibility(view: &StudentView, id: &str) -> Visibility {
        let mut items = view.all_items.iter();
        items.find(|entry| entry.item.id == id).unwrap().visibility
    }

    #[test]
    fn a_task_is_open_only_if_all_of_its_items_are() {
        let one = view("'triangle.edge' = 'points'");
        assert_eq!(visibility(&one, "triangle.edge"), Visibility::Points);
        assert_eq!(visibility(&one, "triangle.inside"), Visibility::Feedback);
        assert_eq!(visibility(&one, "camera.corners"), Visibility::All);
        // Items that weren't open in the first place keep their visibility.
        let all = view("triangle = 'points'\n'triangle.edge' = 'hidden'");
        assert_eq!(visibility(&all, "triangle.inside"), Visibility::Points);
        assert_eq!(visibility(&all, "triangle.edge"), Visibility::Hidden);
    }

    #[test]
    fn the_time_is_shown_only_with_everything_else() {
        assert_eq!(view("").milliseconds(), Some(1_500));
        assert_eq!(view("'bbox.flat' = 'feedback'").milliseconds(), None);
    }

    #[test]
    fn hidden_items_are_summed_up_in_one() {
        let view = view("'build.memory' = 'hidden'\n'build.depth' = 'after_due'");
        let items = view
            .visible_items()
            .filter(|(task, _)| task.id.id() == "build");
        let ids: Vec<&str> = items.map(|(_, item)| item.id.as_str()).collect();
        assert_eq!(ids, ["build.partition", "build.leaves", "build.not_shown"]);
        assert_eq!(view.visible_items().count(), 13);
        assert_eq!(view.all_items.len(), 14);
    }

    #[test]
    fn a_notice_counts_graded_items_only_if_none_is_hidden() {
        let notice = |policy: &str| {
            let score = sample::of_final_exam(sample::unfinished_score());
            sample::view(&score, policy, 0).unfinished_notice()
        };
        for (policy, count) in [
            ("", "13 of 14"),
            ("[visibility.items]\nbbox = 'hidden'", "only some"),
        ] {
            let end = "items have been graded; the others have no points yet";
            let expected = format!("UNFINISHED: {count} {end}");
            assert_eq!(notice(policy), Some(expected));
        }
        assert_eq!(view("").unfinished_notice(), None);
    }
}
